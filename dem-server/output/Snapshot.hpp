// SPDX-License-Identifier: BSD-3-Clause
/// A state on disk that is complete and unharmed, or refused.
///
/// The file is HDF5 (h5py, h5dump open it) behind a user block of 512 bytes: a few lines of text with the format
/// version, the kind, the size and the XXH3 checksum of all that follows.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace gimdem::output
{

/// Version of the format; a reader accepts its own only.
inline constexpr int snapshot_version = 1;

/// Collects named arrays and attributes; commit() makes the file appear whole.
class SnapshotWriter
{
public:
    /// `kind` says what the state is of, e.g. "settled bed"; the reader must ask for the same.
    SnapshotWriter(std::filesystem::path file, std::string kind);
    ~SnapshotWriter();  ///< without commit() nothing is written
    SnapshotWriter(SnapshotWriter const&) = delete;
    SnapshotWriter& operator=(SnapshotWriter const&) = delete;

    /// Add an array, shape=(values.size() / components, components), row-major; components = 1: shape=(n,).
    void add(std::string const& name, std::span<double const> values, int components = 1);
    void add(std::string const& name, std::span<std::int64_t const> values, int components = 1);
    void add(std::string const& name, std::span<std::int32_t const> values, int components = 1);

    /// Add a single value.
    void set(std::string const& name, double value);
    void set(std::string const& name, std::int64_t value);
    void set(std::string const& name, std::string const& value);

    /// Write the file: to a temporary one beside it, which is synced and renamed.
    /// Throws UserError with the path and the system's reason; an older file is then untouched.
    void commit();

private:
    struct Image;
    std::filesystem::path file_;
    std::string kind_;
    std::unique_ptr<Image> image_;
};

/// Opens a snapshot and checks every byte of it before any value is given out.
class SnapshotReader
{
public:
    /// Throws UserError where the file is absent, cut short, changed, of another version or of another kind.
    SnapshotReader(std::filesystem::path const& file, std::string const& kind);
    ~SnapshotReader();
    SnapshotReader(SnapshotReader const&) = delete;
    SnapshotReader& operator=(SnapshotReader const&) = delete;

    bool has(std::string const& name) const;        ///< an array or value of this name
    int components(std::string const& name) const;  ///< of an array

    /// An array as it was added. Throws UserError where it is absent or of another type.
    std::vector<double> doubles(std::string const& name) const;
    std::vector<std::int64_t> int64s(std::string const& name) const;
    std::vector<std::int32_t> int32s(std::string const& name) const;

    /// A single value as it was set. Throws UserError where it is absent or of another type.
    double number(std::string const& name) const;
    std::int64_t integer(std::string const& name) const;
    std::string text(std::string const& name) const;

private:
    struct Image;
    std::unique_ptr<Image const> image_;
};

}  // namespace gimdem::output
