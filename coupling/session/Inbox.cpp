// SPDX-License-Identifier: BSD-3-Clause
#include "session/Inbox.hpp"

#include <algorithm>
#include <utility>

namespace gimdem::coupling::session
{
namespace
{

/// The protocol has one message in flight. A peer that sends more than this without being read is out of order anyway:
/// the first letters tell so, and the rest need not be kept.
std::size_t constexpr capacity = 16;
/// Of those, with arrays.
std::size_t constexpr large_capacity = 2;

bool is_large(Letter const& letter)
{
    return !letter.message.arrays.empty();
}

}  // namespace

void Inbox::put(Letter letter)
{
    {
        std::lock_guard<std::mutex> const lock(mutex_);
        contact_ = true;
        auto const large = static_cast<std::size_t>(std::count_if(letters_.begin(), letters_.end(), is_large));
        bool const fits = letters_.size() < capacity && (!is_large(letter) || large < large_capacity);
        if (fits) letters_.push_back(std::move(letter));
    }
    changed_.notify_all();
}

void Inbox::end(transport::Ending ending)
{
    {
        std::lock_guard<std::mutex> const lock(mutex_);
        ending_ = std::move(ending);
    }
    changed_.notify_all();
}

void Inbox::note_contact()
{
    {
        std::lock_guard<std::mutex> const lock(mutex_);
        contact_ = true;
    }
    changed_.notify_all();
}

Delivery Inbox::wait(transport::Time deadline)
{
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait_until(lock, deadline, [this] { return !letters_.empty() || ending_; });
    if (letters_.empty()) return {std::nullopt, ending_};
    Delivery delivery{std::move(letters_.front()), std::nullopt};
    letters_.pop_front();
    return delivery;
}

bool Inbox::wait_for_contact(transport::Time deadline)
{
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait_until(lock, deadline, [this] { return contact_ || ending_; });
    return contact_ || ending_;
}

std::optional<message::Kind> Inbox::peek() const
{
    std::lock_guard<std::mutex> const lock(mutex_);
    if (letters_.empty()) return std::nullopt;
    return letters_.front().refusal ? message::Kind::KIND_NOT_SET : letters_.front().message.kind();
}

bool Inbox::has_ended() const
{
    std::lock_guard<std::mutex> const lock(mutex_);
    return ending_.has_value();
}

std::optional<transport::Ending> Inbox::ending() const
{
    std::lock_guard<std::mutex> const lock(mutex_);
    return ending_;
}

bool Inbox::has_contact() const
{
    std::lock_guard<std::mutex> const lock(mutex_);
    return contact_;
}

}  // namespace gimdem::coupling::session
