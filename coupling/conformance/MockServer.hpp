// SPDX-License-Identifier: BSD-3-Clause
/// A server without particles: it plays one session by a script and writes down what it finds out about the client.
#pragma once

#include <string>
#include <vector>

#include "conformance/Findings.hpp"
#include "conformance/KnownSolid.hpp"
#include "gimdem/coupling/Server.hpp"

namespace gimdem::conformance
{

/// What the server does wrong, or asks for.
enum class Misbehaviour
{
    none,
    refuse_mesh,    ///< however good it is
    request_stop,   ///< with the answer of step `at`
    delay,          ///< the answer of step `at` comes late; heartbeats go on
    report_error,   ///< instead of the answer of step `at`
    die,            ///< killed instead of the answer of step `at`
    fall_silent,    ///< stopped instead of the answer of step `at`: no heartbeats any more
    wrong_version,  ///< speaks protocol 2
    truncate        ///< sends a field that is too short with the first solid
};

/// What request_stop, refuse_mesh and report_error say; a good client shows it to its user.
inline constexpr char const* mock_reason = "because the script of the mock server says so";

struct Script
{
    std::string endpoint;
    std::string keys;  ///< folder of keys; empty: none
    coupling::Schedule schedule = coupling::Schedule::serial;
    double end_time = 0.01;  ///< told to the client [s]
    std::vector<std::string> needs{coupling::field::velocity, coupling::field::velocity_gradient,
                                   coupling::field::pressure_gradient, coupling::field::void_fraction_gradient,
                                   coupling::field::pressure};
    KnownSolid::Law law;
    Misbehaviour misbehaviour = Misbehaviour::none;
    int at = 2;                ///< step of the misbehaviour
    double delay = 2;          ///< [s]
    double timeout = 10;       ///< a client silent for this long is dead [s]
    double connect_time = 60;  ///< how long to wait for a client [s]
};

/// Plays the session to its end. False if the client broke it off or broke a rule where the script did not make it.
bool play(Script const& script, FindingsFile& findings);

}  // namespace gimdem::conformance
