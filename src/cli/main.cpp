// SPDX-License-Identifier: Apache-2.0
// The program: turns whatever is thrown into one line and an exit code.
#include "src/cli/options.hpp"
#include "src/cli/report.hpp"
#include "src/cli/run.hpp"
#include "src/cli/signals.hpp"
#include "src/cli/streams.hpp"

#include <fastrt/error.hpp>

#include <sys/resource.h>

#include <chrono>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <string>
#include <system_error>

namespace {

using namespace fastrt::cli;

// What is below is a crash. OpenMP's threads get stacks of this size too.
void check_stack() {
  constexpr rlim_t least = rlim_t{1} << 20U;
  rlimit limit{};
  if (getrlimit(RLIMIT_STACK, &limit) == 0 && limit.rlim_cur < least)
    throw fastrt::LimitError("a stack of " + std::to_string(limit.rlim_cur >> 10U) +
                             " KiB is too small: 1024 are needed (ulimit -s)");
}

int fail(const char* message, ExitCode code) {
  print_error(message);
  return code;
}

int guarded_main(int argc, char** argv, std::chrono::steady_clock::time_point start) {
  try {
    const Options options = parse_options(argc, argv);
    if (options.answer) {
      print_out(*options.answer);
      return exit_done;
    }
    check_stack();
    return run(options, start);
  } catch (const fastrt::UsageError& error) {
    return fail((std::string(error.what()) + " (see fastrt --help)").c_str(), exit_usage);
  } catch (const fastrt::InputError& error) {
    return fail(error.what(), exit_input);
  } catch (const fastrt::OutputError& error) {
    return fail(error.what(), exit_output);
  } catch (const fastrt::LimitError& error) {
    return fail(error.what(), exit_limit);
  } catch (const std::bad_alloc&) {
    std::fputs("fastrt: error: out of memory\n", stderr); // without asking for any
    return exit_limit;
  } catch (const std::length_error&) {
    return fail("out of memory", exit_limit);
  } catch (const std::filesystem::filesystem_error& error) {
    return fail(error.what(), exit_output);
  } catch (const std::system_error& error) {
    return fail(error.what(), exit_limit);
  } catch (const std::exception& error) {
    return fail((std::string("a bug in fastrt: ") + error.what()).c_str(), exit_bug);
  }
}

} // namespace

int main(int argc, char** argv) {
  const auto start = std::chrono::steady_clock::now();
  fill_closed_streams();
  install_signal_handlers();
  return guarded_main(argc, argv, start);
}
