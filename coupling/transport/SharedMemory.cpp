// SPDX-License-Identifier: BSD-3-Clause
#include "transport/SharedMemory.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#include <cerrno>
#include <random>
#include <string_view>
#include <system_error>

#include "gimdem/coupling/Error.hpp"

namespace gimdem::coupling::transport
{
namespace
{

std::string_view constexpr prefix = "/gimdem-";
std::string_view constexpr digits = "0123456789abcdef";
std::size_t constexpr random_digits = 32;  ///< 128 bits: nobody guesses them

std::string reason(int error)
{
    return std::generic_category().message(error);
}

std::string unguessable_name()
{
    std::random_device random;
    std::string name = std::string(prefix) + std::to_string(::getpid()) + "-";
    for (std::size_t k = 0; k < random_digits; ++k)
        name += digits[random() % digits.size()];
    return name;
}

/// Could unguessable_name() have made it?
bool is_well_formed(std::string_view name)
{
    auto const only = [](std::string_view text, std::string_view allowed)
    { return !text.empty() && text.find_first_not_of(allowed) == std::string_view::npos; };
    if (name.substr(0, prefix.size()) != prefix) return false;
    name.remove_prefix(prefix.size());
    std::size_t const dash = name.find('-');
    std::size_t constexpr longest_process = 10;
    return dash != std::string_view::npos && dash <= longest_process && only(name.substr(0, dash), "0123456789") &&
           name.size() - dash - 1 == random_digits && only(name.substr(dash + 1), digits);
}

[[noreturn]] void refuse(std::string const& problem)
{
    throw CouplingError(Fault::protocol, problem);
}

void check_notice(SegmentNotice const& notice)
{
    if (!is_well_formed(notice.name))
        refuse(
            "the name of a shared memory segment is none of ours (it begins with /gimdem-, a process number, and 32 "
            "hexadecimal digits)");
    if (notice.bytes == 0 || notice.bytes > max_segment_bytes)
        refuse("a shared memory segment of " + std::to_string(notice.bytes) + " bytes (1 to " +
               std::to_string(max_segment_bytes) + ")");
}

/// A file descriptor that is closed at the end of a scope.
struct Descriptor
{
    explicit Descriptor(int number) : value(number) {}
    ~Descriptor()
    {
        if (value >= 0) ::close(value);
    }
    Descriptor(Descriptor const&) = delete;
    Descriptor& operator=(Descriptor const&) = delete;
    int value;
};

/// Sets the size and takes that much memory from the system; an error number, or 0.
int reserve(int file, std::uint64_t bytes)
{
    int error = EINTR;
    while (error == EINTR)
        error = ::posix_fallocate(file, 0, static_cast<off_t>(bytes));
    return error;
}

}  // namespace

Mapping::~Mapping()
{
    ::munmap(data_, bytes_);
}

void OwnSegment::remove_name() noexcept
{
    ::shm_unlink(notice_.name.c_str());  // the reader may have been faster
}

Attempt<OwnSegment> make_segment(std::uint64_t bytes)
{
    std::string const size = std::to_string(bytes) + " bytes of shared memory";
    if (bytes == 0 || bytes > max_segment_bytes) return {nullptr, size + " are out of range"};
    SegmentNotice const notice{unguessable_name(), bytes};
    Descriptor const file(::shm_open(notice.name.c_str(), O_RDWR | O_CREAT | O_EXCL, S_IRUSR | S_IWUSR));
    if (file.value < 0) return {nullptr, "shared memory cannot be made (" + reason(errno) + ")"};

    int error = reserve(file.value, bytes);
    void* const data = error != 0
                           ? MAP_FAILED
                           : ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_POPULATE, file.value, 0);
    if (error == 0 && data == MAP_FAILED) error = errno;
    if (error == 0) return {std::make_shared<OwnSegment>(notice, data), ""};
    ::shm_unlink(notice.name.c_str());
    return {nullptr, size + " cannot be reserved (" + reason(error) + ")"};
}

Attempt<Mapping const> map_segment(SegmentNotice const& notice)
{
    check_notice(notice);
    Descriptor const file(::shm_open(notice.name.c_str(), O_RDONLY, 0));
    if (file.value < 0) return {nullptr, "the peer's shared memory cannot be opened (" + reason(errno) + ")"};
    struct stat status = {};
    if (::fstat(file.value, &status) != 0 || !S_ISREG(status.st_mode) || status.st_uid != ::geteuid())
        return {nullptr, "the peer's shared memory belongs to another user"};
    if (static_cast<std::uint64_t>(status.st_size) < notice.bytes)
        refuse("a shared memory segment has " + std::to_string(status.st_size) + " bytes instead of the " +
               std::to_string(notice.bytes) + " that were announced");

    void* const data = ::mmap(nullptr, notice.bytes, PROT_READ, MAP_SHARED | MAP_POPULATE, file.value, 0);
    if (data == MAP_FAILED) return {nullptr, "the peer's shared memory cannot be mapped (" + reason(errno) + ")"};
    ::shm_unlink(notice.name.c_str());
    return {std::make_shared<Mapping const>(data, notice.bytes), ""};
}

}  // namespace gimdem::coupling::transport
