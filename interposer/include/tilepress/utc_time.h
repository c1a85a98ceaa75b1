// UTC time: when something was made, as run.json and provenance.json write it.
#pragma once

#include <string>

namespace tilepress {

/// The current time in UTC, ISO 8601, in seconds: "2026-11-28T23:05:06Z".
std::string utc_now();

}  // namespace tilepress
