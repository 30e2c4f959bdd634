// SPDX-License-Identifier: MIT
#include "command_line/interruption.hpp"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdio>

namespace jetlag {

namespace {

std::atomic<bool> stop = false;
extern "C" void request_stop(int) { stop = true; }

}  // namespace

void stop_in_good_order() {
  struct sigaction action{};
  action.sa_handler = request_stop;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  struct sigaction before{};
  sigaction(SIGHUP, nullptr, &before);
  if (before.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);  // nohup goes on
}

bool stop_requested() { return stop; }

ProgressLine::ProgressLine(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0) {}

ProgressLine::~ProgressLine() {
  if (shown_ && terminal_) std::fprintf(stderr, "\r%*s\r", 78, "");
}

void ProgressLine::show(double time, double until, std::uint64_t count, const char* what) {
  if (quiet_ || since_shown_.seconds() < (terminal_ ? 0.1 : 3)) return;
  since_shown_ = {};
  shown_ = true;
  const double elapsed = since_begin_.seconds();
  const double done = time / until;
  std::fprintf(stderr, "%s%5.1f %%   t = %.4g s of %.4g s   %llu %s   %.3g s left   %s",
               terminal_ ? "\r" : "", 100 * done, time, until, static_cast<unsigned long long>(count), what,
               elapsed / done - elapsed, terminal_ ? "" : "\n");
}

}  // namespace jetlag
