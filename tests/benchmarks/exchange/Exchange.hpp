// SPDX-License-Identifier: BSD-3-Clause
/// One way for the fields of a step to go to another process and back.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "ExchangeScene.hpp"

namespace gimdem::bench
{

/// What a way is made of.
struct Way
{
    std::string name;
    std::string transport;       ///< ipc or tcp
    bool shared_memory = false;  ///< ipc only
    coupling::Encodings encodings;
};

/// The near end; the far end, in a process of its own, answers at once.
class Exchange
{
public:
    virtual ~Exchange() = default;
    /// One round trip.
    virtual void exchange() = 0;
    /// Bytes of a round trip, both ways.
    virtual double bytes() const = 0;
};

/// A session of gimdem. Fork before any other thread runs.
std::unique_ptr<Exchange> coupled(Way const& way, Scene const& scene);

/// ZeroMQ alone: a DEALER and a ROUTER send multipart messages with frames of the sizes that `scene` has with these
/// encodings. Nothing is copied, looked at or unpacked by us.
std::unique_ptr<Exchange> bare(Way const& way, Scene const& scene);

}  // namespace gimdem::bench
