// SPDX-License-Identifier: BSD-3-Clause
/// What a mock server found out about a client, line by line.
#pragma once

#include <cstdio>
#include <optional>
#include <string>
#include <vector>

namespace gimdem::conformance
{

enum class Verdict
{
    passed,
    failed,
    skipped  ///< could not be tried, or the client does not show it
};

/// One line of the table.
struct Finding
{
    std::string name;
    Verdict verdict = Verdict::passed;
    std::string text;
};

/// Writes findings and facts to a file as they come, so that a server that dies leaves what it found so far.
class FindingsFile
{
public:
    explicit FindingsFile(std::FILE* file) : file_(file) {}

    void add(Finding const& finding);
    void pass(std::string const& name, std::string const& text) { add({name, Verdict::passed, text}); }
    void fail(std::string const& name, std::string const& text) { add({name, Verdict::failed, text}); }
    void skip(std::string const& name, std::string const& text) { add({name, Verdict::skipped, text}); }
    void check(std::string const& name, bool passed, std::string const& text)
    {
        add({name, passed ? Verdict::passed : Verdict::failed, text});
    }
    /// Something to know that is neither good nor bad: "endpoint", "timeout".
    void tell(std::string const& name, std::string const& value);

private:
    std::FILE* file_;
};

/// "ok", "FAILED", "--".
char const* word_of(Verdict verdict);

/// What has been written so far. facts: what was told.
std::vector<Finding> read_findings(std::string const& file_name);
std::optional<std::string> read_fact(std::string const& file_name, std::string const& name);

}  // namespace gimdem::conformance
