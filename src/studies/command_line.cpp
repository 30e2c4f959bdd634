// SPDX-License-Identifier: MIT
#include "studies/command_line.hpp"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <charconv>
#include <csignal>
#include <cstdio>

#include "jetlag/scenes/error.hpp"

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

void add_out(CLI::App& command, std::filesystem::path& folder, const std::string& description) {
  command.add_option("--out", folder, description)->check([](const std::string& name) {
    return name.empty() ? std::string("got \"\"; must be the name of a folder") : std::string();
  });
}

void SceneArguments::add_to(CLI::App& command) {
  command.add_option("scene", scene, "a built-in scene or a JSON file")->required();
  command.add_option("--set", settings, "replace a value: key.path=value, may be repeated")
      ->allow_extra_args(false);
  command.add_option("--seed", seed, "seed of the random numbers");
}

Scene SceneArguments::load() const {
  if (seed.empty()) return load_scene(scene, settings);
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(seed.data(), seed.data() + seed.size(), number);
  if (error != std::errc() || end != seed.data() + seed.size())
    throw SceneError("--seed: got " + seed + "; must be a whole number from 0 to 18446744073709551615");
  return load_scene(scene, settings, number);
}

ProgressLine::ProgressLine(bool quiet)
    : quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0) {}

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
