// SPDX-License-Identifier: BSD-3-Clause
#include "transport/Mailbox.hpp"

#include <linux/futex.h>
#include <sched.h>
#include <sys/syscall.h>
#include <unistd.h>
#include <algorithm>
#include <atomic>
#include <climits>
#include <cstring>
#include <ctime>
#include <string>
#include <utility>

#include "gimdem/coupling/Error.hpp"

namespace gimdem::coupling::transport
{

struct MailboxPage
{
    std::atomic<std::uint32_t> bell;    ///< how often it has rung: odd while a message is packed
    std::uint32_t bytes;                ///< of the envelope
    std::int64_t posted;                ///< steady clock [ns]
    std::uint32_t complete;             ///< 0: the last message was abandoned
    std::atomic<std::uint32_t> packed;  ///< arrays of the present message
    unsigned char envelope[max_posted_bytes];
    std::atomic<std::uint32_t> processor;  ///< that the sender runs on, + 1; 0: not known
};
static_assert(sizeof(MailboxPage) == mailbox_bytes && std::atomic<std::uint32_t>::is_always_lock_free);

namespace
{

[[noreturn]] void refuse(std::string const& problem)
{
    throw CouplingError(Fault::protocol, problem);
}

/// Who is awake waits so long for the next array before it sleeps: longer than it takes to pack a field of a hundred
/// thousand cells.
auto constexpr patience = std::chrono::microseconds(500);
/// And so long from a knock to the ring: longer than it takes to lay a message out.
auto constexpr patience_after_knock = std::chrono::microseconds(100);

/// Where the mailbox of a segment is. A segment's size is a multiple of a cache line, or it is not one of ours.
unsigned char* place_in(Mapping const& memory)
{
    if (memory.bytes() < mailbox_bytes || memory.bytes() % alignof(MailboxPage) != 0)
        refuse("a shared memory segment of " + std::to_string(memory.bytes()) + " bytes has no mailbox");
    return memory.data() + memory.bytes() - mailbox_bytes;
}

}  // namespace

Outbox::Outbox(std::shared_ptr<OwnSegment const> segment)
    : segment_(std::move(segment)), page_(reinterpret_cast<MailboxPage*>(place_in(segment_->memory())))
{
}

void Outbox::ring()
{
    page_->bell.fetch_add(1, std::memory_order_release);
    wake_reader();
}

void Outbox::knock()
{
    wake_reader();
}

void Outbox::wake_reader()
{
    page_->processor.store(static_cast<std::uint32_t>(::sched_getcpu() + 1), std::memory_order_relaxed);
    ::syscall(SYS_futex, &page_->bell, FUTEX_WAKE, INT_MAX, nullptr, nullptr, 0);
}

void Outbox::announce(Frame const& envelope)
{
    page_->packed.store(0, std::memory_order_relaxed);
    page_->bytes = static_cast<std::uint32_t>(envelope.size());
    std::memcpy(page_->envelope, envelope.data(), envelope.size());
    ring();
}

void Outbox::pack(std::size_t arrays)
{
    page_->packed.store(static_cast<std::uint32_t>(arrays), std::memory_order_release);
}

void Outbox::finish()
{
    page_->posted = std::chrono::nanoseconds(Clock::now().time_since_epoch()).count();
    page_->complete = 1;
    ring();
}

void Outbox::abandon()
{
    page_->complete = 0;
    ring();
}

Postbox::Postbox(std::shared_ptr<Mapping const> segment)
    : segment_(std::move(segment)), page_(reinterpret_cast<MailboxPage const*>(place_in(*segment_)))
{
}

std::uint32_t Postbox::bell()
{
    return seen_ = page_->bell.load(std::memory_order_acquire);
}

std::optional<Frame> Postbox::look()
{
    std::uint32_t const rung = bell();
    bool const is_packed = rung % 2 == 0;
    std::uint32_t const announcement = is_packed ? rung - 1 : rung;
    if (rung == 0 || announcement == announced_ || (is_packed && page_->complete == 0)) return std::nullopt;

    std::size_t const bytes = page_->bytes;
    if (bytes > max_posted_bytes)
        refuse("an envelope of " + std::to_string(bytes) + " bytes in a mailbox of " +
               std::to_string(max_posted_bytes));
    Frame envelope(page_->envelope, bytes);
    std::atomic_thread_fence(std::memory_order_acquire);
    if (bell() - announcement > 1) return std::nullopt;  // abandoned, and the next one written over it
    announced_ = announcement;
    return envelope;
}

Postbox::Packing Postbox::packing(std::function<void(std::size_t)> const& meanwhile)
{
    std::uint32_t packed = 0;
    for (Time until = Clock::now() + patience; bell() == announced_;)
    {
        if (std::uint32_t const now = page_->packed.load(std::memory_order_acquire); now != packed)
        {
            packed = now;
            if (meanwhile) meanwhile(packed);
            until = Clock::now() + patience;
        }
        if (is_in_the_way() || Clock::now() > until) return Packing::going_on;
    }
    return seen_ == announced_ + 1 && page_->complete != 0 ? Packing::complete : Packing::abandoned;
}

Time Postbox::posted()
{
    Time const told(std::chrono::nanoseconds(page_->posted));
    return last_ = std::clamp(told, last_, Clock::now());
}

/// Were we woken on the very processor that the sender was about to use?
bool Postbox::is_in_the_way() const
{
    return page_->processor.load(std::memory_order_relaxed) == static_cast<std::uint32_t>(::sched_getcpu() + 1);
}

void Postbox::wait(Time until) const
{
    auto const left = std::chrono::nanoseconds(until - Clock::now()).count();
    if (left <= 0) return;
    timespec time{};
    time.tv_sec = static_cast<std::time_t>(left / 1'000'000'000);
    time.tv_nsec = static_cast<long>(left % 1'000'000'000);
    // Returns at once if the bell has rung since look().
    bool const woken = ::syscall(SYS_futex, &page_->bell, FUTEX_WAIT, seen_, &time, nullptr, 0) == 0;
    if (!woken) return;
    for (Time const end = Clock::now() + patience_after_knock; Clock::now() < end && !is_in_the_way();)
        if (page_->bell.load(std::memory_order_acquire) != seen_) return;
}

}  // namespace gimdem::coupling::transport
