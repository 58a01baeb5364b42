// SPDX-License-Identifier: BSD-3-Clause
/// A coupling step that is given up leaves no trace on a device either.
#include <gtest/gtest.h>

#include "DeviceBackends.hpp"
#include "RewindScene.hpp"

namespace
{

using namespace gimdem;
using namespace gimdem::test;

class DeviceGoBackTest : public OnDevice
{
};

TEST_P(DeviceGoBackTest, LeavesNoTraceOfThePassesThatWereGivenUp)
{
    expect_passes_leave_no_trace(GetParam(), RewindScene::made(), true);
}

GIMDEM_ON_DEVICES(DeviceGoBackTest);

}  // namespace
