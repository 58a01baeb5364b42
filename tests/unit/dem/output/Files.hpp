// SPDX-License-Identifier: BSD-3-Clause
/// Folders, files and failures for tests of writers.
#pragma once

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "core/Error.hpp"

namespace gimdem::test
{

/// An empty folder that is gone at the end.
class Folder
{
public:
    Folder()
    {
        auto const* test = testing::UnitTest::GetInstance()->current_test_info();
        path_ = std::filesystem::path(testing::TempDir()) / ("gimdem_" + std::to_string(::getpid())) /
                (std::string(test->test_suite_name()) + '_' + test->name());
        std::filesystem::remove_all(path_);
        std::filesystem::create_directories(path_);
    }
    ~Folder()
    {
        std::filesystem::remove_all(path_);
        std::error_code not_empty;
        std::filesystem::remove(path_.parent_path(), not_empty);
    }
    Folder(Folder const&) = delete;
    Folder& operator=(Folder const&) = delete;

    std::filesystem::path operator/(std::string const& name) const { return path_ / name; }
    std::filesystem::path const& path() const { return path_; }

private:
    std::filesystem::path path_;
};

/// No file of this process can grow beyond `bytes`, as on a disk that is full, until the end of the scope.
class FullDisk
{
public:
    explicit FullDisk(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN))
    {
        ::getrlimit(RLIMIT_FSIZE, &before_);
        rlimit const limit{bytes, before_.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FullDisk()
    {
        ::setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }
    FullDisk(FullDisk const&) = delete;
    FullDisk& operator=(FullDisk const&) = delete;

private:
    rlimit before_{};
    void (*handler_)(int);
};

inline std::string read_text(std::filesystem::path const& file)
{
    std::ifstream in(file, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

inline void write_text(std::filesystem::path const& file, std::string const& text)
{
    std::ofstream(file, std::ios::binary) << text;
}

/// What the UserError of `action` says.
template <class Action>
std::string message_of(Action const& action)
{
    try
    {
        action();
    }
    catch (UserError const& error)
    {
        return error.what();
    }
    return "no error";
}

}  // namespace gimdem::test
