// SPDX-License-Identifier: BSD-3-Clause
/// A place for the files of a test.
#pragma once

#include <unistd.h>
#include <atomic>
#include <filesystem>
#include <string>
#include <system_error>

namespace gimdem::test
{

/// A folder that is removed with its contents.
class TemporaryFolder
{
public:
    TemporaryFolder() : path_(std::filesystem::temp_directory_path() / unique_name())
    {
        std::filesystem::create_directories(path_);
    }
    ~TemporaryFolder()
    {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryFolder(TemporaryFolder const&) = delete;
    TemporaryFolder& operator=(TemporaryFolder const&) = delete;

    std::filesystem::path operator/(std::string const& name) const { return path_ / name; }

private:
    static std::string unique_name()
    {
        static std::atomic<int> count{0};
        return "gimdem-integration-" + std::to_string(::getpid()) + "-" + std::to_string(++count);
    }

    std::filesystem::path path_;
};

}  // namespace gimdem::test
