// SPDX-License-Identifier: BSD-3-Clause
/// Wakes a thread that polls.
#pragma once

namespace gimdem::coupling::transport
{

/// An event descriptor: signal() from any thread makes descriptor() readable until clear().
class Wakeup
{
public:
    Wakeup();
    ~Wakeup();
    Wakeup(Wakeup const&) = delete;
    Wakeup& operator=(Wakeup const&) = delete;

    int descriptor() const { return descriptor_; }
    void signal() noexcept;
    void clear() noexcept;

private:
    int descriptor_;
};

}  // namespace gimdem::coupling::transport
