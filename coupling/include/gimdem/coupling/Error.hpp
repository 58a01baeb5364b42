// SPDX-License-Identifier: BSD-3-Clause
/// The one exception of the coupling library.
#pragma once

#include <stdexcept>
#include <string>

namespace gimdem::coupling
{

/// Why a session ended.
enum class Fault
{
    user,      ///< wrong options or an illegal call
    version,   ///< the peers speak different protocols
    protocol,  ///< a message that is malformed or not allowed in this state
    mesh,      ///< the mesh was refused
    timeout,   ///< the peer was silent, or did not answer in time
    peer,      ///< the peer reported an error or disappeared
    endpoint   ///< the address cannot be bound or reached
};

/// Thrown by Client and Server. what() tells the problem, why it is one, and what to do, with both sides' reasons
/// where both are known.
class CouplingError : public std::runtime_error
{
public:
    CouplingError(Fault fault, std::string const& what) : std::runtime_error(what), fault_(fault) {}
    Fault fault() const { return fault_; }

private:
    Fault fault_;
};

}  // namespace gimdem::coupling
