// SPDX-License-Identifier: BSD-3-Clause
#include "gimdem/coupling/Status.hpp"
#include "message/Codec.hpp"
#include "message/Control.hpp"
#include "message/StatusMessages.hpp"
#include "session/Session.hpp"
#include "transport/Question.hpp"

namespace gimdem::coupling
{
namespace
{

using Silence = transport::Reply::Silence;

[[noreturn]] void explain(Silence silence, std::string const& endpoint, double timeout)
{
    std::string const where = " at " + endpoint;
    std::string const within = " within " + session::seconds_text(timeout);
    switch (silence)
    {
        case Silence::nobody:
            throw CouplingError(Fault::endpoint, "nobody listens" + where +
                                                     " (the server has ended, or uses another endpoint); give the "
                                                     "endpoint of a server that runs");
        case Silence::not_zeromq:
            throw CouplingError(Fault::protocol, "who listens" + where +
                                                     " is not a gimdem server (it does not speak ZeroMQ, or hung up on "
                                                     "us for want of keys); give the endpoint of a server that runs, "
                                                     "and the keys if it has any");
        case Silence::locked_out:
            throw CouplingError(Fault::user, "the server" + where +
                                                 " does not let us in (it has keys, and ours are absent or unknown to "
                                                 "it); give the folder of keys of one of its clients");
        case Silence::hung_up:
            throw CouplingError(Fault::peer, "the server" + where +
                                                 " has ended without an answer (its connection broke); its own output "
                                                 "should tell why");
        case Silence::no_greeting:
            throw CouplingError(Fault::timeout, "who listens" + where + " has not greeted" + within +
                                                    " (it is stopped, or not a gimdem server); see what it is, or "
                                                    "allow more time");
        default:
            throw CouplingError(Fault::timeout, "the server" + where + " has not answered" + within +
                                                    " (it is stopped, speaks protocol 1.0, which has no answer, or is "
                                                    "not a gimdem server); see what it is, or allow more time");
    }
}

}  // namespace

Status query_status(std::string const& endpoint, double timeout, std::string const& keys)
{
    std::optional<transport::ClientKeys> own;
    if (!keys.empty()) own = transport::read_client_keys(keys);
    transport::Reply reply =
        transport::ask(endpoint, message::encode(message::pack_status_request("gimdem status")), timeout, own);
    if (reply.frames.empty()) explain(reply.silence, endpoint, timeout);
    try
    {
        message::Message const answer = message::decode(std::move(reply.frames));
        if (answer.kind() == message::Kind::kError)
        {
            message::ErrorReport const report = message::unpack_error(answer);
            throw CouplingError(report.fault, "server \"" + report.name + "\" refuses to answer: " + report.reason);
        }
        if (answer.kind() != message::Kind::kStatus) message::refuse("it answered with " + message::describe(answer));
        return message::unpack_status(answer);
    }
    catch (CouplingError const& error)
    {
        throw CouplingError(error.fault(), "who listens at " + endpoint + " gave no status: " + error.what());
    }
}

}  // namespace gimdem::coupling
