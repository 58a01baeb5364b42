// SPDX-License-Identifier: BSD-3-Clause
#include "session/ExchangeClock.hpp"

#include <gtest/gtest.h>

namespace gimdem::coupling::session
{
namespace
{

double constexpr rounding = 1e-8;  ///< clock ticks are nanoseconds [s]

Time at(double seconds)
{
    return Time() + transport::ticks(seconds);
}

TEST(ExchangeClock, SerialExchangeIsTheCallWithoutTheBusyServer)
{
    ExchangeClock clock;
    clock.sent(at(1), at(1.1));
    clock.answered_serial(at(4), 2.5);
    EXPECT_NEAR(clock.times().waiting, 2.5, rounding);
    EXPECT_NEAR(clock.times().exchange, 0.5, rounding);

    clock.sent(at(10), at(10.1));
    clock.answered_serial(at(12), 1.75);
    EXPECT_NEAR(clock.times().waiting, 4.25, rounding) << "summed over the run";
    EXPECT_NEAR(clock.times().exchange, 0.75, rounding);
}

TEST(ExchangeClock, SerialServerCannotBeBusierThanTheCall)
{
    ExchangeClock clock;
    clock.sent(at(1), at(1));
    clock.answered_serial(at(2), 5);
    EXPECT_NEAR(clock.times().waiting, 1, rounding);
    EXPECT_NEAR(clock.times().exchange, 0, rounding);
}

TEST(ExchangeClock, OverlappedServerThatWasFasterCostsNoWaiting)
{
    ExchangeClock clock;
    clock.sent(at(0), at(0.1));
    clock.answered_overlapped(at(5), at(2), at(5.2), 1.8);
    EXPECT_NEAR(clock.times().waiting, 0, rounding);
    EXPECT_NEAR(clock.times().exchange, 0.1 + 0.2, rounding) << "packing and unpacking";
}

TEST(ExchangeClock, OverlappedServerThatWasSlowerIsWaitedFor)
{
    ExchangeClock clock;
    // 0.1 packing, then 0.3 on the way, 6 busy: arrival at 6.4; the client was ready at 2 and unpacked until 6.5.
    clock.sent(at(0), at(0.1));
    clock.answered_overlapped(at(2), at(6.4), at(6.5), 6);
    EXPECT_NEAR(clock.times().waiting, 4.4 - 0.3, rounding);
    EXPECT_NEAR(clock.times().exchange, 0.1 + 0.3 + 0.1, rounding);
}

}  // namespace
}  // namespace gimdem::coupling::session
