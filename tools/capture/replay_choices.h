// Replay choices: the options that choose how traces are replayed.
#pragma once

#include <CLI/App.hpp>
#include <chrono>

#include "tilepress/trace_replay.h"

namespace tilepress {

/// Adds --api, --display and --timeout. The places must outlive the parsing by `app`.
void add_replay_choices(CLI::App& app, RetracerChoice& retracer, ReplayDisplay& display,
                        std::chrono::seconds& timeout);

}  // namespace tilepress
