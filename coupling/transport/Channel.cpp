// SPDX-License-Identifier: BSD-3-Clause
#include "transport/Channel.hpp"

#include <chrono>
#include <csignal>
#include <exception>
#include <utility>

namespace gimdem::coupling::transport
{
namespace
{

using namespace std::chrono_literals;

/// A broken connection reaches ZeroMQ's routing table within microseconds; look for so long, so often.
auto constexpr probe_time = 500ms;
auto constexpr probe_interval = 10ms;

/// Messages that are read before heartbeats and what is to be sent have their turn again, whatever strangers send.
int constexpr messages_per_turn = 64;
/// Read before the end, in search of the last words of the peer.
int constexpr last_messages = 1024;

}  // namespace

Channel::Channel(Socket socket, double timeout, ChannelHooks hooks)
    : socket_(std::move(socket)),
      endpoint_(socket_.endpoint()),
      hooks_(std::move(hooks)),
      liveness_(timeout, Clock::now()),
      probe_until_(Clock::now())
{
    start_thread();
}

Channel::~Channel()
{
    close(0ms);
}

void Channel::start_thread()
{
    // Signals belong to the program's own threads.
    sigset_t all;
    sigset_t before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    thread_ = std::thread([this] { run(); });
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

void Channel::send(Frames frames)
{
    {
        std::lock_guard<std::mutex> const lock(mutex_);
        queue_.push_back(std::move(frames));
    }
    wakeup_.signal();
}

void Channel::close(Clock::duration linger) noexcept
{
    if (!thread_.joinable()) return;
    closing_ = true;
    wakeup_.signal();
    thread_.join();
    bool const anyone_listens = liveness_.has_contact() && !lost_;
    socket_.close(anyone_listens ? linger : Clock::duration::zero());
}

void Channel::run() noexcept
{
    try
    {
        while (!closing_)
            turn();
        send_queued();
    }
    catch (std::exception const& error)
    {
        lost_ = true;
        end({Ending::Kind::lost, 0, error.what()});
    }
}

void Channel::turn()
{
    Time const planned = Clock::now();
    Time until = liveness_.next_turn(planned);
    if (planned < probe_until_) until = std::min(until, planned + probe_interval);
    socket_.wait(wakeup_.descriptor(), until);
    wakeup_.clear();

    // The break is noted before the last messages are read, and reported after them.
    bool const broke = socket_.connection_broke();
    tell_notes();
    liveness_.turn(Clock::now());
    send_queued();
    receive_some(messages_per_turn);
    if (broke) handle_broken_connection();
    if (socket_.was_refused()) end({Ending::Kind::refused, 0, ""});

    Time const now = Clock::now();
    if (liveness_.beat_due(now) || now < probe_until_) beat(now);
    if (auto const silence = liveness_.silence(now)) end({Ending::Kind::silent, *silence, ""});
}

void Channel::send_queued()
{
    std::deque<Frames> ready;
    {
        std::lock_guard<std::mutex> const lock(mutex_);
        ready.swap(queue_);
    }
    // After a break ZeroMQ would keep the frames for whoever opens the endpoint next.
    for (Frames& frames : ready)
        if (!lost_ && !socket_.send(peer_, frames)) lose();
}

void Channel::tell_notes()
{
    for (std::string const& text : socket_.take_notes())
        if (hooks_.note) hooks_.note(text);
}

void Channel::receive_some(int most)
{
    for (int k = 0; k < most; ++k)
    {
        auto parcel = socket_.receive();
        if (!parcel) return;
        receive_from(std::move(*parcel), Clock::now());
    }
}

bool Channel::answer_question(Parcel& parcel)
{
    if (!hooks_.answer_question) return false;
    auto answer = hooks_.answer_question(parcel.frames);
    if (answer && !answer->empty()) socket_.send(parcel.sender, *answer);
    return answer.has_value();
}

void Channel::receive_from(Parcel parcel, Time now)
{
    if (answer_question(parcel)) return;
    if (!liveness_.has_contact())
    {
        if (parcel.frames.empty() || !hooks_.may_open(parcel.frames.front())) return;
        peer_ = parcel.sender;
    }
    if (parcel.sender == peer_)
    {
        liveness_.heard(now);
        auto const peer_timeout = hooks_.deliver(std::move(parcel.frames), now);
        if (peer_timeout) liveness_.set_peer_timeout(*peer_timeout);
        return;
    }
    Frames answer = hooks_.answer_stranger(std::move(parcel.frames));
    if (!answer.empty()) socket_.send(parcel.sender, answer);
}

void Channel::handle_broken_connection()
{
    if (socket_.role() == Role::server)
        probe_until_ = Clock::now() + probe_time;  // whose it was, the next heartbeats tell
    else
        lose();
}

void Channel::beat(Time now)
{
    liveness_.beaten(now);
    if (ended_ || !liveness_.has_contact()) return;
    Frames frames = hooks_.heartbeat();
    if (!socket_.send(peer_, frames)) lose();
}

void Channel::lose()
{
    lost_ = true;
    receive_some(last_messages);                    // the last words of the peer, which may explain it
    static_cast<void>(socket_.connection_broke());  // and a refusal, which may have come since we looked
    end({socket_.was_refused() ? Ending::Kind::refused : Ending::Kind::lost, 0, ""});
}

void Channel::end(Ending ending)
{
    if (ended_) return;
    ended_ = true;
    hooks_.ended(std::move(ending));
}

}  // namespace gimdem::coupling::transport
