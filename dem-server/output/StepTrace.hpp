// SPDX-License-Identifier: BSD-3-Clause
/// The trace of a coupled run: what both programs did in each step.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "gimdem/coupling/StepTimes.hpp"
#include "output/TraceFile.hpp"

namespace gimdem::output
{

/// A part of a step, by the server's clock [s].
struct Slice
{
    std::string_view name;
    double from = 0, to = 0;
};

/// What the server did in a step.
struct ServerStep
{
    std::int64_t number = 0;
    coupling::ServerTimes times;
    double computing = 0;       ///< the particles began to move [s]
    coupling::Timings timings;  ///< the same that the client is told
    double done = 0;            ///< logs and checkpoints were written [s]
};

/// In order of time, without overlap: waiting, exchange, output, DEM, mapping, exchange, records.
std::vector<Slice> slices_of(ServerStep const& step);

/// The same of a client: exchange, waiting, CFD, output. The sums over a run of exchange and waiting are those that the
/// client reports; CFD and output are the client's timings, or its whole time between the calls if it told none.
std::vector<Slice> slices_of(coupling::ClientTimes const& times, coupling::Timings const& timings,
                             coupling::ClockOffset const& clock);

/// How much is traced.
struct TraceChoice
{
    std::int64_t steps = 0;  ///< so many, then no more; 0: none
    std::int64_t every = 1;  ///< of the run's first step, the one so many later, ...
};

/// A named number at the end of a step.
struct Counter
{
    std::string_view name;
    double value = 0;
};

class StepTrace
{
public:
    /// origin: when the run began [s].
    StepTrace(std::filesystem::path const& file, double origin, TraceChoice const& choice, std::string const& client);

    bool wants(std::int64_t step) const;
    void add(ServerStep const& step, std::vector<Counter> const& counters);
    void add(coupling::ClientTimes const& times, coupling::Timings const& timings, coupling::ClockOffset const& clock);

    /// Wall time that the trace itself took so far [s].
    double cost() const { return cost_; }

private:
    void add_slices(int process, std::vector<Slice> const& slices, double from, double to, std::int64_t step);

    TraceFile file_;
    TraceChoice choice_;
    std::int64_t first_ = 0;  ///< step of the run; 0 before it
    double cost_ = 0;
};

}  // namespace gimdem::output
