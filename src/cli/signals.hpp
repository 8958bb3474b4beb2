// SPDX-License-Identifier: Apache-2.0
// SIGINT and SIGTERM end the program within half a second and leave no broken file.
#pragma once

#include <atomic>

namespace fastrt::cli {

// What the program is doing when a signal comes.
enum class Phase {
  idle,      // nothing that a sudden end would harm: it ends at once
  rendering, // cancelled() is set, and half a second later it ends at the latest
  saving,    // a file is being put in its place, which takes a moment: it ends after that
};

// Installs the handlers. SIGXFSZ is ignored, so that a file over its size limit is an ordinary error.
void install_signal_handlers();

void enter_phase(Phase phase) noexcept;

// For RenderSettings::cancelled.
const std::atomic<bool>& cancelled() noexcept;

// The share of the rendering that is done, for the last words.
void note_progress(double share) noexcept;

// The signal that came, or 0.
int signal_received() noexcept;

// Ends the program for the signal that came: one line on stderr, exit code 128 + signal. Nothing is cleaned
// up, which could take long.
[[noreturn]] void end_by_signal() noexcept;

} // namespace fastrt::cli
