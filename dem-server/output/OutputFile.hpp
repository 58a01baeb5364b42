// SPDX-License-Identifier: BSD-3-Clause
/// A file that appears whole or not at all.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>
#include <utility>

namespace gimdem::output
{

/// Throw UserError: cannot `action` `file` (text of errno); what to do.
[[noreturn]] void fail_with_errno(std::string_view action, std::filesystem::path const& file);

/// Create a folder and those above it. Throws UserError.
void make_folder(std::filesystem::path const& folder);

/// An open file, closed at the end.
class Descriptor
{
public:
    Descriptor() = default;
    explicit Descriptor(int number) : number_(number) {}
    ~Descriptor() { close(); }
    Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
    Descriptor& operator=(Descriptor&& other) noexcept
    {
        std::swap(number_, other.number_);
        return *this;
    }

    int get() const { return number_; }

    /// @returns false with errno set where the system reports an error, e.g. a full disk only now.
    bool close();

private:
    int number_ = -1;
};

/// Open `file` for writing, created where it is absent. Throws UserError naming `shown`.
Descriptor open_to_write(std::filesystem::path const& file, int flags, std::filesystem::path const& shown);

/// Write all bytes to an open file. Throws UserError naming `file`.
void write_all(int descriptor, std::span<std::byte const> bytes, std::filesystem::path const& file);

/// Collects bytes in `file`.part; commit() renames it to `file`. Without commit() nothing is left behind.
class OutputFile
{
public:
    enum class Durability
    {
        process,  ///< survives a crash of this process
        machine   ///< survives a power cut: synced to the disk before the rename
    };

    explicit OutputFile(std::filesystem::path file);
    ~OutputFile();
    OutputFile(OutputFile const&) = delete;
    OutputFile& operator=(OutputFile const&) = delete;

    void write(std::span<std::byte const> bytes) { write_all(descriptor_.get(), bytes, file_); }
    void write(std::string_view text) { write(std::as_bytes(std::span(text))); }

    void commit(Durability durability = Durability::process);

private:
    std::filesystem::path file_;
    std::filesystem::path part_;
    Descriptor descriptor_;
};

}  // namespace gimdem::output
