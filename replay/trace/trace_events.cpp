// Trace events: the event stream of an apitrace trace as a sequence of calls.
#include "trace_events.h"

#include <algorithm>

namespace tilepress {
namespace {

// Numbers of the file format (apitrace's docs/FORMAT).
enum : uint8_t { kEnter = 0, kLeave = 1 };
enum : uint8_t { kEnd = 0, kArgument = 1, kResult = 2, kThread = 3, kBacktrace = 4, kFlags = 5 };
enum : uint8_t { kFrameEnd = 0, kModule = 1, kFunction = 2, kFileName = 3, kLineNumber = 4, kOffset = 5 };

}  // namespace

bool TraceEvents::read_header() {
  version_ = semantic_version_ = stream_.read_uint();
  if (version_ > kNewestVersion) return false;
  values_.set_version(version_);
  if (version_ < 6) return true;
  semantic_version_ = stream_.read_uint();
  for (;;) {
    std::string name = stream_.read_string(kMaxNameBytes);
    if (name.empty()) return true;
    if (properties_.size() == kMaxProperties) fail_corrupt("too many properties");
    std::string value = stream_.read_string(kMaxPropertyBytes);
    properties_.emplace_back(std::move(name), std::move(value));
  }
}

bool TraceEvents::next(TraceCall& call) {
  while (!stream_.at_end()) {
    const uint8_t event = stream_.read_byte();
    if (event == kEnter) {
      read_enter();
    } else if (event == kLeave) {
      if (read_leave(call)) return true;
    } else {
      fail_corrupt("unknown event " + std::to_string(event));
    }
  }
  return false;
}

void TraceEvents::read_enter() {
  TraceCall call;
  if (version_ >= 4) call.thread = stream_.read_uint();
  call.function = read_function();
  call.number = calls_entered_++;
  if (open_.size() >= kMaxOpenCalls) fail_corrupt("too many calls that never return");
  read_details(call, functions_[call.function].watched);
  open_.emplace(call.number, std::move(call));
}

bool TraceEvents::read_leave(TraceCall& call) {
  const auto found = open_.find(stream_.read_uint());
  if (found == open_.end()) {  // the trace lacks its beginning
    TraceCall stray;
    read_details(stray, false);
    return false;
  }
  call = std::move(found->second);
  open_.erase(found);  // before the details: a retracer drops a call whose return is cut off
  read_details(call, functions_[call.function].watched);
  return true;
}

std::vector<TraceCall> TraceEvents::open_calls() const {
  std::vector<TraceCall> calls;
  for (const auto& [number, call] : open_) calls.push_back(call);
  std::sort(calls.begin(), calls.end(),
            [](const TraceCall& a, const TraceCall& b) { return a.number < b.number; });
  return calls;
}

uint32_t TraceEvents::read_function() {
  const uint64_t id = stream_.read_uint();
  if (id >= kMaxFunctions) fail_corrupt("function number " + std::to_string(id) + " is out of range");
  if (id >= functions_.size()) functions_.resize(id + 1);
  TraceFunction& function = functions_[id];
  if (!function.known) {
    function.name = stream_.read_string(kMaxNameBytes);
    const uint64_t arguments = stream_.read_uint();
    if (arguments > kMaxArguments)
      fail_corrupt("a function claims " + std::to_string(arguments) + " arguments");
    for (uint64_t left = arguments; left > 0; --left) stream_.skip_string();
    function.watched = watch_(function.name);
    function.known = true;
  }
  return static_cast<uint32_t>(id);
}

void TraceEvents::read_details(TraceCall& call, bool keep) {
  values_.begin_call();
  for (;;) {
    const uint8_t detail = stream_.read_byte();
    switch (detail) {
      case kEnd:
        return;
      case kArgument: {
        const uint64_t position = stream_.read_uint();
        if (position >= kMaxArguments)
          fail_corrupt("argument number " + std::to_string(position) + " is out of range");
        if (!keep) {
          values_.skip();
          break;
        }
        if (position >= call.arguments.size()) call.arguments.resize(position + 1);
        call.arguments[position] = values_.read();
        break;
      }
      case kResult:
        if (keep)
          call.result = values_.read();
        else
          values_.skip();
        break;
      case kThread:
        call.thread = stream_.read_uint();
        break;
      case kBacktrace:
        skip_backtrace();
        break;
      case kFlags:
        stream_.read_uint();
        break;
      default:
        fail_corrupt("unknown call detail " + std::to_string(detail));
    }
  }
}

void TraceEvents::skip_backtrace() {
  for (uint64_t left = stream_.read_uint(); left > 0; --left) {
    const uint64_t id = stream_.read_uint();
    if (stack_frames_.contains(id)) continue;
    if (stack_frames_.size() >= kMaxStackFrames) fail_corrupt("too many stack frames");
    stack_frames_.insert(id);
    for (uint8_t detail = stream_.read_byte(); detail != kFrameEnd; detail = stream_.read_byte()) {
      if (detail == kModule || detail == kFunction || detail == kFileName)
        stream_.skip_string();
      else if (detail == kLineNumber || detail == kOffset)
        stream_.read_uint();
      else
        fail_corrupt("unknown stack frame detail " + std::to_string(detail));
    }
  }
}

}  // namespace tilepress
