// SPDX-License-Identifier: BSD-3-Clause
#include "core/NearestKey.hpp"

#include <algorithm>
#include <numeric>

namespace gimdem
{

std::size_t edit_distance(std::string_view a, std::string_view b)
{
    // three rows of the table distance(first i letters of a, first j letters of b)
    std::vector<std::size_t> before(b.size() + 1);
    std::vector<std::size_t> above(b.size() + 1);
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i)
    {
        std::swap(before, above);
        std::swap(above, row);
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j)
        {
            std::size_t const replaced = above[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            row[j] = std::min({above[j] + 1, row[j - 1] + 1, replaced});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = std::min(row[j], before[j - 2] + 1);
        }
    }
    return row.back();
}

std::string nearest_key(std::string_view word, std::vector<std::string> const& known)
{
    std::string nearest;
    std::size_t smallest = std::max<std::size_t>(2, word.size() / 3) + 1;
    for (auto const& candidate : known)
    {
        std::size_t const distance = edit_distance(word, candidate);
        if (distance < smallest && distance < std::max(word.size(), candidate.size()))
        {
            smallest = distance;
            nearest = candidate;
        }
    }
    return nearest;
}

std::string suggest_key(std::string_view word, std::vector<std::string> const& known)
{
    std::string const nearest = nearest_key(word, known);
    if (!nearest.empty()) return "did you mean \"" + nearest + "\"?";
    std::string list;
    for (auto const& candidate : known)
        list += (list.empty() ? "" : ", ") + candidate;
    return "known are: " + list;
}

}  // namespace gimdem
