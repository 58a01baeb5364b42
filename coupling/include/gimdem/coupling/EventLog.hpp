// SPDX-License-Identifier: BSD-3-Clause
/// A structured log: one JSON object a line, of both sides on one clock.
///
///     {"time": "2026-01-31T12:00:00.123456Z", "elapsed": 1.234567, "side": "server", "level": "info",
///      "event": "client_connected", "message": "gimdemFoam connected", "fields": {"schedule": "serial"}}
///
/// `time` is the wall clock in UTC; `elapsed` [s] counts from the start of the server, by the server's monotonic clock.
#pragma once

#include <initializer_list>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace gimdem::coupling
{

enum class LogLevel
{
    info,
    warning,
    error
};

/// One named value of an event.
struct EventField
{
    EventField(std::string given, double number);
    EventField(std::string given, std::string const& text);
    EventField(std::string given, char const* text) : EventField(std::move(given), std::string(text)) {}

    std::string name;
    std::string json;  ///< the value, as JSON writes it
};

/// Each line reaches the file whole and at once, so what was logged before a crash can be read. A full disk loses lines
/// and nothing else. Any thread.
class EventLog
{
public:
    /// Writes nothing.
    EventLog() = default;
    /// Adds to the file. side: "server" or "client". Lines are held until the origin is known.
    /// CouplingError(user) if the file cannot be opened.
    EventLog(std::string const& file, std::string side);
    /// Writes what is held; without an origin, its own first line counts as one.
    ~EventLog();
    EventLog(EventLog const&) = delete;
    EventLog& operator=(EventLog const&) = delete;

    /// When the run began, by this machine's monotonic clock [s].
    void set_origin(double origin);

    void write(LogLevel level, char const* event, std::string const& message,
               std::initializer_list<EventField> fields = {});

    bool is_open() const { return descriptor_ >= 0; }

private:
    struct Line
    {
        double clock;       ///< [s]
        std::string begin;  ///< up to the elapsed time
        std::string end;    ///< from there
    };

    void put(Line const& line) const;
    void release();

    int descriptor_ = -1;
    std::string side_;
    std::mutex mutex_;  ///< guards what follows
    std::optional<double> origin_;
    std::vector<Line> held_;
};

}  // namespace gimdem::coupling
