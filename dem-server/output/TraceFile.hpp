// SPDX-License-Identifier: BSD-3-Clause
/// A trace that Perfetto (ui.perfetto.dev) and chrome://tracing open: what ran when, on one time axis.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace gimdem::output
{

/// Chrome's trace events as a JSON array. Events of a step reach the file together, so a run that is killed leaves the
/// steps before; that array lacks its closing bracket, which readers of this format allow.
class TraceFile
{
public:
    /// Times of events count from `origin`, by the same clock [s]. Throws UserError if the file cannot be made.
    TraceFile(std::filesystem::path const& file, double origin);
    ~TraceFile();  ///< as close()
    TraceFile(TraceFile const&) = delete;
    TraceFile& operator=(TraceFile const&) = delete;

    /// One row of the picture; `process` is any number that later events use.
    void name_process(int process, std::string const& name);
    /// From then to then [s].
    void slice(int process, std::string_view name, double from, double to, std::int64_t step);
    /// A curve over time.
    void counter(int process, std::string_view name, double at, double value);

    /// Writes what has been added. A full disk ends the trace, not the run.
    void flush();
    void close();
    bool is_open() const { return descriptor_ >= 0; }

private:
    void add(std::string const& event);
    std::string microseconds(double seconds) const;

    int descriptor_ = -1;
    double origin_;
    bool is_empty_ = true;
    std::string waiting_;  ///< not written yet
};

}  // namespace gimdem::output
