// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <charconv>

#include "core/CaseReader.hpp"
#include "core/CaseText.hpp"

namespace gimdem::case_file
{

Rule anything()
{
    return {};
}

Rule above(double low)
{
    return {"> " + to_text(low), [low](double x) { return x > low; }, {}, {}};
}

Rule at_least(double low)
{
    return {">= " + to_text(low), [low](double x) { return x >= low; }, {}, {}};
}

Rule within(double low, double high)
{
    return {"in [" + to_text(low) + ", " + to_text(high) + "]",
            [low, high](double x) { return low <= x && x <= high; },
            {},
            {}};
}

Rule between(double low, double high)
{
    return {"in (" + to_text(low) + ", " + to_text(high) + ")",
            [low, high](double x) { return low < x && x < high; },
            {},
            {}};
}

Rule fraction(double low, double high)
{
    return {"in (" + to_text(low) + ", " + to_text(high) + "]",
            [low, high](double x) { return low < x && x <= high; },
            {},
            {}};
}

Rule one_of(std::vector<std::string> const& words)
{
    std::string text;
    for (auto const& word : words)
        text += (text.empty() ? "" : " | ") + word;
    auto const is_one = [words](std::string const& word)
    { return std::find(words.begin(), words.end(), word) != words.end(); };
    return {text, {}, is_one, words};
}

Rule not_empty()
{
    return {"not empty", {}, [](std::string const& text) { return !text.empty(); }, {}};
}

namespace
{

/// tcp://host:port with a port in [1, 65535].
bool is_tcp_endpoint(std::string const& text)
{
    std::string const scheme = "tcp://";
    auto const colon = text.rfind(':');
    if (!text.starts_with(scheme) || colon <= scheme.size()) return false;
    int port = 0;
    char const* const end = text.data() + text.size();
    auto const [stop, error] = std::from_chars(text.data() + colon + 1, end, port);
    return error == std::errc{} && stop == end && 1 <= port && port <= 65535;
}

}  // namespace

Rule endpoint()
{
    auto const is_endpoint = [](std::string const& text)
    { return text == "ipc" || (text.starts_with("ipc://") && text.size() > 6) || is_tcp_endpoint(text); };
    return {"ipc | ipc:///path | tcp://host:port", {}, is_endpoint, {}};
}

}  // namespace gimdem::case_file
