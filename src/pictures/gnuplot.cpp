// SPDX-License-Identifier: MIT
// gnuplot as a child process. All its files have fixed names in a folder of their own beside the picture, so that no name
// a user chose is ever part of a command; a picture that is there is complete.
#include "pictures/gnuplot.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include "jetlag/base/text.hpp"
#include "jetlag/output/files.hpp"

namespace jetlag::gnuplot {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const std::string& what, int error) {
  throw std::runtime_error(what + ": " + std::generic_category().message(error));
}

/// An empty folder beside a picture, for as long as this lives: a draft, which the next run sweeps where the process was
/// killed.
class Workshop {
 public:
  explicit Workshop(const fs::path& picture) {
    for (int n = 0; path.empty(); ++n) {
      const fs::path folder = draft_beside(picture, n);
      if (::mkdir(folder.c_str(), 0700) == 0)
        path = folder;
      else if (errno != EEXIST)
        fail("cannot write " + shown_name(picture.string()), errno);
    }
  }
  Workshop(const Workshop&) = delete;
  Workshop& operator=(const Workshop&) = delete;
  ~Workshop() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  fs::path path;
};

/// What the child has instead of a terminal, and where it works.
class Surroundings {
 public:
  explicit Surroundings(const fs::path& folder) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_addchdir_np(&actions_, folder.c_str());
    posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, "messages", O_WRONLY | O_CREAT | O_APPEND,
                                     0600);
    posix_spawn_file_actions_adddup2(&actions_, STDOUT_FILENO, STDERR_FILENO);
  }
  Surroundings(const Surroundings&) = delete;
  Surroundings& operator=(const Surroundings&) = delete;
  ~Surroundings() { posix_spawn_file_actions_destroy(&actions_); }
  const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_;
};

/// Runs gnuplot on the file "script" of the folder; returns whether it succeeded.
bool run(const fs::path& gnuplot, const fs::path& folder) {
  const Surroundings surroundings(folder);
  // -d: the pictures do not depend on the user's own settings.
  std::string name = "gnuplot", defaults = "-d", script = "script";
  char* const arguments[] = {name.data(), defaults.data(), script.data(), nullptr};
  pid_t child = 0;
  if (const int error =
          ::posix_spawn(&child, gnuplot.c_str(), surroundings.get(), nullptr, arguments, environ);
      error != 0)
    fail("cannot start " + gnuplot.string(), error);
  int status = 0;
  while (::waitpid(child, &status, 0) == -1)
    if (errno != EINTR) fail("lost sight of gnuplot", errno);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

std::string terminal(const fs::path& picture, const Sheet& sheet) {
  const std::string common = fmt::format("size {:.0f},{:.0f} background rgb 'white' font 'sans-serif,{:.0f}'",
                                         sheet.width, sheet.height, sheet.letters);
  if (picture.extension() == ".svg") return "set terminal svg dynamic rounded " + common + "\n";
  if (picture.extension() != ".png")
    throw std::invalid_argument("a picture must be .png or .svg, got " + shown_name(picture.string()));
  // gnuplot's points are 4/3 pixels in a PNG and 1 pixel in an SVG.
  return "if (strstrt(GPVAL_TERMINALS, ' pngcairo ') > 0) {\n  set terminal pngcairo rounded fontscale "
         "0.75 " +
         common + "\n} else {\n  set terminal png truecolor rounded fontscale 0.75 " + common + "\n}\n";
}

}  // namespace

fs::path program() {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (folder.empty()) continue;
    const fs::path candidate = fs::path(folder) / "gnuplot";
    std::error_code ignored;
    if (fs::is_regular_file(candidate, ignored) && ::access(candidate.c_str(), X_OK) == 0)
      return fs::absolute(candidate);
  }
  return {};
}

std::string quoted(std::string_view text) {
  std::string safe = "'";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    safe += code < 32 || code == 127 ? ' ' : c;
    if (c == '\'') safe += c;
  }
  return safe + "'";
}

void draw(const fs::path& picture, const Sheet& sheet, const std::string& commands, const std::string& data) {
  const std::string start = "set encoding utf8\n" + terminal(picture, sheet) + "set output 'picture'\n";
  const fs::path gnuplot = program();
  if (gnuplot.empty())
    throw std::runtime_error("gnuplot is not in PATH; it draws " + shown_name(picture.string()));
  const Workshop workshop(picture);
  write_file(workshop.path / "data.csv", data);
  write_file(workshop.path / "script", start + commands + "\nunset output\n");
  if (!run(gnuplot, workshop.path))
    throw std::runtime_error("gnuplot failed to draw " + shown_name(picture.string()) + ": " +
                             read_file(workshop.path / "messages"));
  write_file(picture, read_file(workshop.path / "picture"));
}

}  // namespace jetlag::gnuplot
