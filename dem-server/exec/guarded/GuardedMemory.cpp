// SPDX-License-Identifier: BSD-3-Clause
#include "exec/guarded/GuardedMemory.hpp"

#include <sys/mman.h>

#include <cstdint>
#include <cstring>
#include <new>
#include <stdexcept>

namespace gimdem::exec
{

namespace
{

constexpr std::size_t page = 4096;
constexpr std::size_t address_space = std::size_t{1} << 37;

/// Whether a number is the address of something in this process.
bool is_mapped(std::uintptr_t address)
{
    unsigned char resident;
    return address >= page && address >> 47 == 0 &&
           mincore(reinterpret_cast<void*>(address / page * page), page, &resident) == 0;
}

}  // namespace

GuardedMemory::GuardedMemory()
{
    void* const space = mmap(nullptr, address_space, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (space == MAP_FAILED) throw std::bad_alloc();
    begin_ = next_ = static_cast<char*>(space);
}

GuardedMemory::~GuardedMemory()
{
    munmap(begin_, address_space);
}

void* GuardedMemory::allocate(std::size_t bytes)
{
    std::size_t const whole = (bytes + page - 1) / page * page;
    if (next_ + whole + page > begin_ + address_space) throw std::bad_alloc();
    char* const array = next_;
    next_ += whole + page;
    arrays_[array] = whole;
    ++allocations_;
    // What was never written is not a number.
    Open const opened = open(array, "allocate");
    std::memset(array, 0xff, whole);
    return array;
}

void GuardedMemory::free(void* p)
{
    auto const array = find(p);
    if (array == arrays_.end()) throw std::logic_error("free of what is not an array of this device");
    madvise(array->first, array->second, MADV_DONTNEED);
    mprotect(array->first, array->second, PROT_NONE);
    arrays_.erase(array);
}

GuardedMemory::Arrays::iterator GuardedMemory::find(void const* p)
{
    auto const address = static_cast<char const*>(p);
    if (address < begin_ || address >= begin_ + address_space) return arrays_.end();
    auto array = arrays_.upper_bound(const_cast<char*>(address));
    if (array == arrays_.begin()) return arrays_.end();
    --array;
    // One past the end is a legal pointer.
    return address <= array->first + array->second ? array : arrays_.end();
}

void GuardedMemory::add(Open& open, Arrays::iterator array)
{
    for (char const* const already : open.arrays_)
        if (already == array->first) return;
    mprotect(array->first, array->second, PROT_READ | PROT_WRITE);
    open.arrays_.push_back(array->first);
}

GuardedMemory::Open GuardedMemory::open_for_kernel(void const* kernel, void const* cleared, std::size_t bytes,
                                                   std::string const& name)
{
    Open opened(*this);
    for (std::size_t at = 0; at + sizeof(std::uintptr_t) <= bytes; at += sizeof(std::uintptr_t))
    {
        std::uintptr_t word, cleared_word;
        std::memcpy(&word, static_cast<char const*>(kernel) + at, sizeof word);
        std::memcpy(&cleared_word, static_cast<char const*>(cleared) + at, sizeof word);
        auto const array = find(reinterpret_cast<void const*>(word));
        if (array != arrays_.end())
            add(opened, array);
        else if (cleared_word == word && is_mapped(word))
            throw std::logic_error("kernel " + name +
                                   " holds an address of the host, or of freed device memory, at byte " +
                                   std::to_string(at) + " of " + std::to_string(bytes) + ": a copy was forgotten");
    }
    return opened;
}

GuardedMemory::Open GuardedMemory::open(void const* p, char const* name)
{
    Open opened(*this);
    auto const array = find(p);
    if (array == arrays_.end()) throw std::logic_error(std::string(name) + ": not an address of this device");
    add(opened, array);
    return opened;
}

GuardedMemory::Open::~Open()
{
    for (char* const array : arrays_)
        mprotect(array, memory_.arrays_.at(array), PROT_NONE);
}

}  // namespace gimdem::exec
