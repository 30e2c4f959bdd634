// SPDX-License-Identifier: MIT
// Files that are either complete or not there, with the means of POSIX.
#include "jetlag/output/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <stdexcept>
#include <system_error>
#include <vector>

#include "jetlag/base/text.hpp"

namespace jetlag {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const char* what, const fs::path& path, int error = errno) {
  throw std::runtime_error(
      fmt::format("{} {}: {}", what, shown_name(path.string()), std::generic_category().message(error)));
}

/// Calls again as long as a signal interrupts.
template <class Call>
auto uninterrupted(Call call) {
  decltype(call()) result;
  do result = call();
  while (result == -1 && errno == EINTR);
  return result;
}

/// A new file beside `target`; it goes away again unless it replaces the target.
class Draft {
 public:
  explicit Draft(const fs::path& target) : target_(target) {
    for (int n = 0; file_ == -1; ++n) {
      draft_ = draft_beside(target, n);
      file_ = uninterrupted(
          [&] { return ::open(draft_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666); });
      if (file_ == -1 && errno != EEXIST) fail("cannot write", target_);
    }
  }
  Draft(const Draft&) = delete;
  Draft& operator=(const Draft&) = delete;
  ~Draft() {
    if (file_ != -1) ::close(file_);
    if (!draft_.empty()) ::unlink(draft_.c_str());
  }

  void write(std::string_view text) {
    while (!text.empty()) {
      const auto written = uninterrupted([&] { return ::write(file_, text.data(), text.size()); });
      if (written == -1) fail("cannot write", target_);
      text.remove_prefix(static_cast<std::size_t>(written));
    }
  }

  void replace_target(Until until) {
    if (until == Until::on_disk && uninterrupted([&] { return ::fsync(file_); }) == -1)
      fail("cannot write", target_);
    const int closed = ::close(file_);
    file_ = -1;  // POSIX leaves open whether a failed close may be tried again; it may not
    if (closed == -1) fail("cannot write", target_);
    if (std::rename(draft_.c_str(), target_.c_str()) == -1) fail("cannot write", target_);
    draft_.clear();
  }

 private:
  fs::path target_, draft_;
  int file_ = -1;
};

/// Whether draft_beside gives such a name: ".jetlag-PID-N".
bool is_draft(std::string_view name) {
  constexpr std::string_view start = ".jetlag-";
  if (!name.starts_with(start)) return false;
  const auto is_number = [](std::string_view text) {
    return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
  };
  const std::string_view rest = name.substr(start.size());
  const auto dash = rest.find('-');
  return dash != std::string_view::npos && is_number(rest.substr(0, dash)) &&
         is_number(rest.substr(dash + 1));
}

}  // namespace

fs::path draft_beside(const fs::path& target, int n) {
  return target.parent_path() / fmt::format(".jetlag-{}-{}", ::getpid(), n);
}

void sweep_drafts(const fs::path& folder) {
  std::error_code ignored;  // what cannot be removed stays, and hinders nobody
  std::vector<fs::path> drafts;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (is_draft(entry.path().filename().string())) drafts.push_back(entry.path());
  for (const fs::path& draft : drafts) fs::remove_all(draft, ignored);
}

void write_file(const fs::path& path, std::string_view text, Until until) {
  // A device or a pipe in this place would be replaced by a file, which nobody means.
  struct stat old{};
  if (::stat(path.c_str(), &old) == 0 && !S_ISREG(old.st_mode))
    fail("cannot write", path, S_ISDIR(old.st_mode) ? EISDIR : EINVAL);
  Draft draft(path);
  draft.write(text);
  draft.replace_target(until);
}

std::string read_file(const fs::path& path) {
  const int file = uninterrupted([&] { return ::open(path.c_str(), O_RDONLY | O_CLOEXEC); });
  if (file == -1) fail("cannot read", path);
  std::string text;
  std::array<char, 65536> part;
  ssize_t size;
  while ((size = uninterrupted([&] { return ::read(file, part.data(), part.size()); })) > 0)
    text.append(part.data(), static_cast<std::size_t>(size));
  const int error = errno;
  ::close(file);
  if (size == -1) fail("cannot read", path, error);
  return text;
}

}  // namespace jetlag
