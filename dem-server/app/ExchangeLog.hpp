// SPDX-License-Identifier: BSD-3-Clause
/// What the exchange with the client costs, as a time series of its own: wall times differ from run to run, bed.csv does
/// not.
#pragma once

#include <cstdint>
#include <filesystem>

#include "gimdem/coupling/Server.hpp"
#include "output/TimeSeries.hpp"

namespace gimdem::app
{

class ExchangeLog
{
public:
    /// interval: of the rows [s]; 0: none.
    ExchangeLog(std::filesystem::path const& folder, double interval);

    /// At the beginning of a step. bytes: received and sent so far.
    void record(coupling::FluidState const& fluid, double bytes);

private:
    /// Sums over the run, as they were at the last row.
    struct Sums
    {
        double bytes = 0, exchange = 0, waiting = 0;  ///< [byte], [s], [s]
        std::int64_t step = 0;
        double time = 0;  ///< simulated [s]
    };

    output::TimeSeries series_;
    double interval_;
    Sums last_;
};

}  // namespace gimdem::app
