// SPDX-License-Identifier: BSD-3-Clause
#include "app/ExchangeLog.hpp"

#include <vector>

namespace gimdem::app
{

ExchangeLog::ExchangeLog(std::filesystem::path const& folder, double interval)
    : series_(folder / "exchange.csv", {{"time", "s"},
                                        {"bytes_per_step", "B"},
                                        {"exchange_per_step", "us"},
                                        {"client_waiting_per_step", "us"}}),
      interval_(interval)
{
}

void ExchangeLog::record(coupling::FluidState const& fluid, double bytes)
{
    Sums const now{bytes, fluid.exchange, fluid.waiting, fluid.step.number, fluid.step.time};
    bool const is_first = last_.step == 0;
    if (!is_first && (interval_ <= 0 || now.time - last_.time < (1 - 1e-6) * interval_)) return;
    auto const steps = static_cast<double>(now.step - last_.step);
    if (!is_first)
        series_.append(std::vector<double>{now.time, (now.bytes - last_.bytes) / steps,
                                           1e6 * (now.exchange - last_.exchange) / steps,
                                           1e6 * (now.waiting - last_.waiting) / steps});
    last_ = now;
}

}  // namespace gimdem::app
