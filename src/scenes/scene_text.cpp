// SPDX-License-Identifier: MIT
#include "scenes/scene_text.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>

#include "jetlag/scenes/error.hpp"
#include "jetlag/scenes/scene.hpp"

namespace jetlag {

namespace {

constexpr std::size_t most_characters = 1'000'000'000;
constexpr int patience = 1000;  // [ms], until somebody writes to a named pipe

/// An open file.
struct File {
  int number;
  bool is_own;
  ~File() {
    if (is_own && number != -1) ::close(number);
  }
};

/// Whether there is something to read, or the end, within a time; patience -1: waits for it.
bool is_ready(int file, int wait) {
  pollfd asked{file, POLLIN, 0};
  int ready = 0;
  do ready = ::poll(&asked, 1, wait);
  while (ready == -1 && errno == EINTR);
  return ready > 0;
}

}  // namespace

std::string scene_text(const std::string& name, const std::string& allowed) {
  const auto refuse = [&](const std::string& why) {
    throw SceneError("scene: got \"" + name + "\"" + (why.empty() ? "" : ": " + why) + "; must be " +
                     allowed);
  };
  const auto reason = [] { return std::generic_category().message(errno); };
  const bool is_standard = name == standard_input;
  // A pipe is opened without waiting for who writes to it.
  const File file{
      is_standard ? STDIN_FILENO : ::open(name.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY),
      !is_standard};
  if (file.number == -1) refuse(errno == ENOENT ? "" : reason());
  struct stat about{};
  if (::fstat(file.number, &about) == -1) refuse(reason());
  const bool is_pipe = S_ISFIFO(about.st_mode);
  if (!is_standard && !is_pipe && !S_ISREG(about.st_mode))
    refuse(S_ISDIR(about.st_mode) ? "is a folder" : "is neither a file nor a pipe");
  const bool has_writer = is_standard || !is_pipe || is_ready(file.number, patience);

  std::string text;
  std::array<char, 65536> part;
  for (;;) {
    const ssize_t size = ::read(file.number, part.data(), part.size());
    if (size > 0) {
      text.append(part.data(), static_cast<std::size_t>(size));
      if (text.size() > most_characters)
        refuse("is longer than " + std::to_string(most_characters) + " characters");
    } else if (size == 0) {
      if (!has_writer && text.empty()) refuse("is a pipe that nobody writes to");
      return text;
    } else if (errno == EAGAIN) {
      is_ready(file.number, -1);
    } else if (errno != EINTR) {
      refuse(reason());
    }
  }
}

}  // namespace jetlag
