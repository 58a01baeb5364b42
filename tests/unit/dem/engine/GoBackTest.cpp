// SPDX-License-Identifier: BSD-3-Clause
/// A coupling step that is given up leaves no trace.
#include <gtest/gtest.h>

#include "RewindScene.hpp"

namespace
{

using namespace gimdem;
using namespace gimdem::test;

TEST(GoBack, LeavesNoTraceOfThePassesThatWereGivenUp)
{
    expect_passes_leave_no_trace(serial, RewindScene::made(), false);
}

TEST(GoBack, PutsBackRollingSpringsAndReferencesOfWeights)
{
    Case settings = RewindScene::made();
    settings.dem.rolling_friction = "epsd";
    settings.contacts[0].rolling_friction = 0.1;
    settings.contacts[0].rolling_damping = 0.3;
    settings.mapping.reuse_distance = 0.05;
    expect_passes_leave_no_trace(serial, settings, false);
}

TEST(GoBack, OneStepAndTheSameAgainGiveTheSameBits)
{
    RewindScene once(serial, RewindScene::made()), twice(serial, RewindScene::made());
    once.advance(1, 1);
    twice.engine->remember();
    twice.advance(1, 1);
    twice.engine->go_back();
    twice.advance(1, 1);
    expect_same(once, twice);
}

}  // namespace
