// SPDX-License-Identifier: BSD-3-Clause
/// Ownership of the file of an ipc socket.
#pragma once

#include <string>

namespace gimdem::coupling::transport
{

/// Holds the right to bind one socket file, from construction to destruction.
///
/// ZeroMQ replaces whatever lies at the path, even the socket of a live server. So the path is claimed first: by a lock
/// on "<path>.lock", which the system releases when its process dies, and by knocking at a socket without a lock. What
/// a dead server left behind is removed. The destructor removes both files.
class IpcPath
{
public:
    /// Fault::endpoint if a live server holds the path, or if something there is not a socket.
    explicit IpcPath(std::string const& path);
    ~IpcPath();
    IpcPath(IpcPath const&) = delete;
    IpcPath& operator=(IpcPath const&) = delete;

private:
    void take_lock();
    void clear_stale_socket() const;

    std::string path_;
    std::string lock_path_;
    int lock_ = -1;  ///< descriptor of the lock file
};

}  // namespace gimdem::coupling::transport
