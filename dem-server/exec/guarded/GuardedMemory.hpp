// SPDX-License-Identifier: BSD-3-Clause
/// Memory that only a kernel or a copy may touch: pages without any right of access, which open for the time of a
/// launch. An array has pages of its own with a closed one behind them, and addresses are never used twice, so that
/// what was freed stays closed.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace gimdem::exec
{

class GuardedMemory
{
public:
    GuardedMemory();
    ~GuardedMemory();
    GuardedMemory(GuardedMemory const&) = delete;
    GuardedMemory& operator=(GuardedMemory const&) = delete;

    void* allocate(std::size_t bytes);
    void free(void* p);
    std::size_t allocations() const { return allocations_; }  ///< since the beginning

    /// Arrays that are accessible as long as this lives.
    class Open
    {
    public:
        ~Open();
        Open(Open&& other) noexcept = default;  // leaves the other with nothing

    private:
        friend GuardedMemory;
        explicit Open(GuardedMemory& memory) : memory_(memory) {}
        GuardedMemory& memory_;
        std::vector<char*> arrays_;
    };

    /// The arrays that a kernel's pointers lead to. Throws std::logic_error where one leads to memory of the host:
    /// `kernel` is its bytes, `cleared` the same with padding cleared, and `name` what to call it.
    Open open_for_kernel(void const* kernel, void const* cleared, std::size_t bytes, std::string const& name);

    /// The array that `p` leads into. Throws std::logic_error for one of the host.
    Open open(void const* p, char const* name);

private:
    using Arrays = std::map<char*, std::size_t>;

    Arrays::iterator find(void const* p);
    void add(Open& open, Arrays::iterator array);

    char* begin_;
    char* next_;
    Arrays arrays_;  ///< begin and bytes, whole pages
    std::size_t allocations_ = 0;
};

}  // namespace gimdem::exec
