// SPDX-License-Identifier: BSD-3-Clause
#include "FoamText.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <sstream>

#include "core/Error.hpp"

namespace gimdem::test
{

namespace
{

constexpr std::string_view marks = "(){};";

bool is_space(char c)
{
    return c == ' ' || c == '\n' || c == '\t' || c == '\r';
}

}  // namespace

FoamText::FoamText(std::filesystem::path const& file) : file_(file)
{
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream content;
    if (!stream || !(content << stream.rdbuf()))
        throw UserError(
            fmt::format("{} cannot be read (a mesh has the files points, faces, owner, neighbour and "
                        "boundary); give a folder polyMesh, or the case that has it in constant",
                        file.string()));
    text_ = std::move(content).str();
    expect("FoamFile");
    expect("{");
    while (!skip("}"))
    {
        bool const is_format = skip("format");
        if (is_format && look() == "binary") fail("format binary, which is not read here; run foamFormatConvert");
        while (next() != ";")
        {
        }
    }
}

void FoamText::fail(std::string_view what) const
{
    auto const line = 1 + std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(at_), '\n');
    throw UserError(fmt::format("{}:{}: {} (the mesh cannot be read); write it again", file_.string(), line, what));
}

// White space and comments.
void FoamText::skip_space()
{
    for (;;)
    {
        while (at_ < text_.size() && is_space(text_[at_]))
            ++at_;
        std::string_view const rest = std::string_view(text_).substr(at_);
        bool const is_line = rest.starts_with("//");
        if (!is_line && !rest.starts_with("/*")) return;
        std::size_t const end = is_line ? rest.find('\n') : rest.find("*/", 2);
        at_ = end == std::string_view::npos ? text_.size() : at_ + end + (is_line ? 1 : 2);
    }
}

std::string_view FoamText::look()
{
    skip_space();
    if (at_ == text_.size()) fail("the file ends too early");
    std::size_t end = at_ + 1;
    if (marks.find(text_[at_]) == std::string_view::npos)
        while (end < text_.size() && !is_space(text_[end]) && marks.find(text_[end]) == std::string_view::npos)
            ++end;
    return std::string_view(text_).substr(at_, end - at_);
}

std::string_view FoamText::next()
{
    std::string_view const word = look();
    at_ += word.size();
    return word;
}

bool FoamText::skip(std::string_view word)
{
    bool const is_next = look() == word;
    if (is_next) at_ += word.size();
    return is_next;
}

void FoamText::expect(std::string_view word)
{
    if (std::string_view const found = look(); found != word)
        fail(fmt::format("\"{}\" where \"{}\" was expected", found, word));
    at_ += word.size();
}

template <class Number>
Number FoamText::parse(std::string_view what)
{
    std::string_view const word = look();
    Number value{};
    auto const [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size())
        fail(fmt::format("\"{}\" where {} was expected", word, what));
    at_ += word.size();
    return value;
}

int FoamText::integer()
{
    return parse<int>("a whole number");
}

double FoamText::number()
{
    return parse<double>("a number");
}

Vec3 FoamText::vector()
{
    expect("(");
    double const x = number(), y = number(), z = number();
    expect(")");
    return {x, y, z};
}

std::vector<int> FoamText::integers()
{
    int const count = integer();
    if (count < 0) fail("a list of less than nothing");
    std::vector<int> list(static_cast<std::size_t>(count));
    if (skip("{"))
    {
        std::ranges::fill(list, integer());
        expect("}");
        return list;
    }
    expect("(");
    for (int& entry : list)
        entry = integer();
    expect(")");
    return list;
}

}  // namespace gimdem::test
