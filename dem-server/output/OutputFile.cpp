// SPDX-License-Identifier: BSD-3-Clause
#include "output/OutputFile.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "core/Error.hpp"

namespace gimdem::output
{

namespace
{

std::string advice(int error)
{
    switch (error)
    {
        case ENOSPC:
        case EDQUOT:
        case EFBIG:
            return "free some space or choose another folder";
        case EACCES:
        case EPERM:
        case EROFS:
            return "give write permission or choose another folder";
        default:
            return "check the path";
    }
}

/// Make a rename in `folder` survive a power cut. Some file systems cannot; that is no reason to stop.
void sync_folder(std::filesystem::path const& folder)
{
    int const descriptor = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return;
    ::fsync(descriptor);
    ::close(descriptor);
}

}  // namespace

void fail_with_errno(std::string_view action, std::filesystem::path const& file)
{
    int const error = errno;
    throw UserError("cannot " + std::string(action) + ' ' + file.string() + " (" + std::strerror(error) + "); " +
                    advice(error));
}

void make_folder(std::filesystem::path const& folder)
{
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (!error) return;
    errno = error.value();
    fail_with_errno("create the folder", folder);
}

bool Descriptor::close()
{
    int const number = std::exchange(number_, -1);
    return number < 0 || ::close(number) == 0;
}

Descriptor open_to_write(std::filesystem::path const& file, int flags, std::filesystem::path const& shown)
{
    Descriptor descriptor(::open(file.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | flags, 0666));
    if (descriptor.get() < 0) fail_with_errno("write", shown);
    return descriptor;
}

void write_all(int descriptor, std::span<std::byte const> bytes, std::filesystem::path const& file)
{
    while (!bytes.empty())
    {
        ::ssize_t const written = ::write(descriptor, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) fail_with_errno("write", file);
        bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
}

OutputFile::OutputFile(std::filesystem::path file) : file_(std::move(file)), part_(file_)
{
    part_ += ".part";
    descriptor_ = open_to_write(part_, O_TRUNC, file_);
}

OutputFile::~OutputFile()
{
    if (!part_.empty()) ::unlink(part_.c_str());
}

void OutputFile::commit(Durability durability)
{
    if (durability == Durability::machine && ::fsync(descriptor_.get()) != 0) fail_with_errno("write", file_);
    if (!descriptor_.close()) fail_with_errno("write", file_);
    if (::rename(part_.c_str(), file_.c_str()) != 0) fail_with_errno("write", file_);
    part_.clear();
    if (durability == Durability::machine) sync_folder(file_.parent_path());
}

}  // namespace gimdem::output
