// SPDX-License-Identifier: BSD-3-Clause
#include "transport/Wakeup.hpp"

#include <sys/eventfd.h>
#include <unistd.h>
#include <cerrno>
#include <system_error>

namespace gimdem::coupling::transport
{

Wakeup::Wakeup() : descriptor_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK))
{
    if (descriptor_ < 0) throw std::system_error(errno, std::generic_category(), "eventfd");
}

Wakeup::~Wakeup()
{
    ::close(descriptor_);
}

// Both calls can only fail because the event is already as wanted.
void Wakeup::signal() noexcept
{
    static_cast<void>(::eventfd_write(descriptor_, 1));
}

void Wakeup::clear() noexcept
{
    eventfd_t count = 0;
    static_cast<void>(::eventfd_read(descriptor_, &count));
}

}  // namespace gimdem::coupling::transport
