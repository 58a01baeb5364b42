// SPDX-License-Identifier: BSD-3-Clause
#include "message/Control.hpp"

#include <array>
#include <utility>

namespace gimdem::coupling::message
{
namespace
{

std::array<std::pair<Fault, v1::FaultKind>, 7> constexpr faults{{{Fault::user, v1::FAULT_KIND_USER},
                                                                 {Fault::version, v1::FAULT_KIND_VERSION},
                                                                 {Fault::protocol, v1::FAULT_KIND_PROTOCOL},
                                                                 {Fault::mesh, v1::FAULT_KIND_MESH},
                                                                 {Fault::timeout, v1::FAULT_KIND_TIMEOUT},
                                                                 {Fault::peer, v1::FAULT_KIND_PEER},
                                                                 {Fault::endpoint, v1::FAULT_KIND_ENDPOINT}}};

v1::FaultKind to_wire(Fault fault)
{
    for (auto const& [ours, wire] : faults)
        if (ours == fault) return wire;
    return v1::FAULT_KIND_PEER;
}

/// A fault that we do not know is still the peer's.
Fault from_wire(v1::FaultKind kind)
{
    for (auto const& [ours, wire] : faults)
        if (wire == kind) return ours;
    return Fault::peer;
}

}  // namespace

Message pack(Heartbeat const& heartbeat)
{
    Message message;
    message.envelope.set_step(heartbeat.step);
    v1::Heartbeat& body = *message.envelope.mutable_heartbeat();
    body.set_name(printable(heartbeat.name));
    body.set_state(heartbeat.state);
    body.set_progress(heartbeat.progress);
    body.set_timeout(heartbeat.timeout);
    return message;
}

Message pack(ErrorReport const& report)
{
    Message message;
    message.envelope.set_step(report.step);
    v1::Error& body = *message.envelope.mutable_error();
    body.set_fault(to_wire(report.fault));
    body.set_reason(printable(report.reason));
    body.set_state(report.state);
    body.set_name(printable(report.name));
    return message;
}

Message pack_goodbye(std::string const& reason)
{
    Message message;
    message.envelope.mutable_goodbye()->set_reason(printable(reason));
    return message;
}

Heartbeat unpack_heartbeat(Message const& message)
{
    v1::Heartbeat const& body = message.envelope.heartbeat();
    check_number(body.timeout(), min_timeout, "Heartbeat: timeout");
    return {body.name().substr(0, max_name_bytes), body.state().substr(0, max_name_bytes), message.envelope.step(),
            body.progress(), body.timeout()};
}

ErrorReport unpack_error(Message const& message)
{
    v1::Error const& body = message.envelope.error();
    return {from_wire(body.fault()), body.reason().substr(0, max_text_bytes), body.state().substr(0, max_name_bytes),
            body.name().substr(0, max_name_bytes), message.envelope.step()};
}

std::string unpack_goodbye(Message const& message)
{
    return message.envelope.goodbye().reason().substr(0, max_text_bytes);
}

}  // namespace gimdem::coupling::message
