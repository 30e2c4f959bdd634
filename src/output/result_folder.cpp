// SPDX-License-Identifier: MIT
#include "jetlag/output/result_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <string>
#include <system_error>

#include "jetlag/base/text.hpp"
#include "jetlag/output/files.hpp"

namespace jetlag {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void refuse(const fs::path& folder, const std::string& why) {
  throw std::runtime_error("cannot write " + shown_name(folder.string()) + ": " + why);
}

}  // namespace

ResultFolder::ResultFolder(const fs::path& folder) {
  fs::create_directories(folder);
  folder_ = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder_ == -1) refuse(folder, std::generic_category().message(errno));
  if (::flock(folder_, LOCK_EX | LOCK_NB) == -1 && errno == EWOULDBLOCK) {
    ::close(folder_);
    refuse(folder, "another run is writing into it; give another folder, or wait for the end of that run");
  }
  sweep_drafts(folder);
}

ResultFolder::~ResultFolder() { ::close(folder_); }

}  // namespace jetlag
