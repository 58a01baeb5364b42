// SPDX-License-Identifier: BSD-3-Clause
/// Expectations on the exception of the coupling library.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <optional>
#include <string>

#include "gimdem/coupling/Error.hpp"

namespace gimdem::test
{

inline std::string name_of(coupling::Fault fault)
{
    switch (fault)
    {
        case coupling::Fault::user:
            return "user";
        case coupling::Fault::version:
            return "version";
        case coupling::Fault::protocol:
            return "protocol";
        case coupling::Fault::mesh:
            return "mesh";
        case coupling::Fault::timeout:
            return "timeout";
        case coupling::Fault::peer:
            return "peer";
        case coupling::Fault::endpoint:
            return "endpoint";
    }
    return "unknown";
}

/// What the action threw, as "fault: text"; "(nothing)" if it threw nothing.
inline std::string thrown_by(std::function<void()> const& action)
{
    try
    {
        action();
    }
    catch (coupling::CouplingError const& error)
    {
        return name_of(error.fault()) + ": " + error.what();
    }
    return "(nothing)";
}

}  // namespace gimdem::test

/// The statement throws CouplingError of that fault, with that part in its text.
#define EXPECT_FAULT(statement, fault, part)                              \
    EXPECT_THAT(                                                          \
        ::gimdem::test::thrown_by([&] { static_cast<void>(statement); }), \
        ::testing::AllOf(::testing::StartsWith(::gimdem::test::name_of(fault) + ": "), ::testing::HasSubstr(part)))
