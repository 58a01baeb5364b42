// SPDX-License-Identifier: BSD-3-Clause
#include "transport/IpcPath.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "gimdem/coupling/Error.hpp"

namespace gimdem::coupling::transport
{
namespace
{

[[noreturn]] void refuse(std::string const& path, std::string const& why)
{
    throw CouplingError(Fault::endpoint, "endpoint \"ipc://" + path + "\" " + why);
}

[[noreturn]] void refuse_in_use(std::string const& path)
{
    refuse(path, "is in use (a live server is bound to it); stop that server or choose another endpoint");
}

/// Does the descriptor still belong to the file of that name, or has someone removed it meanwhile?
bool is_file_of(int descriptor, std::string const& path)
{
    struct stat open_file
    {
    };
    struct stat named_file
    {
    };
    return ::fstat(descriptor, &open_file) == 0 && ::stat(path.c_str(), &named_file) == 0 &&
           open_file.st_ino == named_file.st_ino && open_file.st_dev == named_file.st_dev;
}

/// Does anyone answer at the socket file?
bool answers(std::string const& path)
{
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path.copy(address.sun_path, sizeof(address.sun_path) - 1);
    int const knock = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    if (knock < 0) return false;
    // EAGAIN: the queue of a live listener is full.
    bool const open = ::connect(knock, reinterpret_cast<sockaddr*>(&address), sizeof(address)) == 0 || errno == EAGAIN;
    ::close(knock);
    return open;
}

}  // namespace

IpcPath::IpcPath(std::string const& path) : path_(std::filesystem::absolute(path).string()), lock_path_(path_ + ".lock")
{
    take_lock();
    try
    {
        clear_stale_socket();
    }
    catch (...)
    {
        ::unlink(lock_path_.c_str());
        ::close(lock_);
        throw;
    }
}

IpcPath::~IpcPath()
{
    ::unlink(path_.c_str());
    ::unlink(lock_path_.c_str());
    ::close(lock_);
}

void IpcPath::take_lock()
{
    while (true)
    {
        lock_ = ::open(lock_path_.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0600);
        if (lock_ < 0)
            refuse(path_, "cannot be bound (" + lock_path_ + ": " + std::strerror(errno) +
                              "); choose a path in a folder that exists and is writable");
        bool const locked = ::flock(lock_, LOCK_EX | LOCK_NB) == 0;
        if (locked && is_file_of(lock_, lock_path_)) return;
        ::close(lock_);
        if (!locked) refuse_in_use(path_);
    }
}

void IpcPath::clear_stale_socket() const
{
    struct stat found
    {
    };
    if (::lstat(path_.c_str(), &found) != 0) return;
    if (!S_ISSOCK(found.st_mode))
        refuse(path_, "cannot be bound (a file that is not a socket lies there); remove it or choose another endpoint");
    if (answers(path_)) refuse_in_use(path_);
    ::unlink(path_.c_str());
}

}  // namespace gimdem::coupling::transport
