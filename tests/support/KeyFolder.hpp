// SPDX-License-Identifier: BSD-3-Clause
/// A folder of fresh keys for a test.
#pragma once

#include <unistd.h>
#include <atomic>
#include <filesystem>
#include <string>

#include "gimdem/coupling/Keys.hpp"

namespace gimdem::test
{

/// Made in the constructor, gone in the destructor.
class KeyFolder
{
public:
    KeyFolder() : path_(std::filesystem::temp_directory_path() / unique_name()) { coupling::make_keys(path_); }
    ~KeyFolder()
    {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    KeyFolder(KeyFolder const&) = delete;
    KeyFolder& operator=(KeyFolder const&) = delete;

    std::filesystem::path const& path() const { return path_; }
    std::filesystem::path operator/(std::string const& name) const { return path_ / name; }

private:
    static std::string unique_name()
    {
        static std::atomic<int> count{0};
        return "gimdem-keys-" + std::to_string(::getpid()) + "-" + std::to_string(++count);
    }

    std::filesystem::path path_;
};

}  // namespace gimdem::test
