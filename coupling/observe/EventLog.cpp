// SPDX-License-Identifier: BSD-3-Clause
#include "gimdem/coupling/EventLog.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <utility>

#include "gimdem/coupling/Error.hpp"
#include "gimdem/coupling/Json.hpp"
#include "gimdem/coupling/StepTimes.hpp"

namespace gimdem::coupling
{
namespace
{

/// Lines that are held while the origin is not known; a client that never meets a server writes a few.
std::size_t constexpr most_held = 1000;

char const* name_of(LogLevel level)
{
    std::array<char const*, 3> constexpr names{"info", "warning", "error"};
    return names[static_cast<std::size_t>(level)];
}

/// "2026-01-31T12:00:00.123456Z"
std::string utc_now()
{
    using namespace std::chrono;
    auto const now = system_clock::now().time_since_epoch();
    auto const whole = duration_cast<seconds>(now);
    std::time_t const at = whole.count();
    std::tm parts{};
    ::gmtime_r(&at, &parts);
    char text[32];
    std::size_t const length = std::strftime(text, sizeof(text), "%Y-%m-%dT%H:%M:%S", &parts);
    std::snprintf(text + length, sizeof(text) - length, ".%06ldZ",
                  static_cast<long>(duration_cast<microseconds>(now - whole).count()));
    return text;
}

}  // namespace

double clock_now()
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

EventField::EventField(std::string given, double number) : name(std::move(given)), json(json_number(number)) {}
EventField::EventField(std::string given, std::string const& text) : name(std::move(given)), json(json_quoted(text)) {}

EventLog::EventLog(std::string const& file, std::string side)
    : descriptor_(::open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666)), side_(std::move(side))
{
    if (descriptor_ < 0)
        throw CouplingError(Fault::user, "the log " + file + " cannot be written (" + std::strerror(errno) +
                                             "); name a file in a folder of yours");
}

EventLog::~EventLog()
{
    if (descriptor_ < 0) return;
    if (!origin_ && !held_.empty()) origin_ = held_.front().clock;
    release();
    ::close(descriptor_);
}

void EventLog::set_origin(double origin)
{
    if (descriptor_ < 0) return;
    std::lock_guard<std::mutex> const lock(mutex_);
    origin_ = origin;
    release();
}

void EventLog::write(LogLevel level, char const* event, std::string const& message,
                     std::initializer_list<EventField> fields)
{
    if (descriptor_ < 0) return;
    std::string values;
    for (EventField const& field : fields)
        values += (values.empty() ? "" : ", ") + json_quoted(field.name) + ": " + field.json;

    std::lock_guard<std::mutex> const lock(mutex_);
    Line line{clock_now(), "{\"time\": \"" + utc_now() + "\", \"elapsed\": ",
              ", \"side\": " + json_quoted(side_) + ", \"level\": \"" + name_of(level) + "\", \"event\": \"" + event +
                  "\", \"message\": " + json_quoted(message) + ", \"fields\": {" + values + "}}\n"};
    if (origin_) return put(line);
    if (held_.size() < most_held) held_.push_back(std::move(line));
}

void EventLog::put(Line const& line) const
{
    char elapsed[32];
    std::snprintf(elapsed, sizeof(elapsed), "%.6f", line.clock - *origin_);
    std::string const text = line.begin + elapsed + line.end;
    // One call a line: lines of two processes that add to one file do not mix. A full disk must not end a run.
    [[maybe_unused]] ssize_t const written = ::write(descriptor_, text.data(), text.size());
}

void EventLog::release()
{
    for (Line const& line : held_)
        put(line);
    held_.clear();
}

}  // namespace gimdem::coupling
