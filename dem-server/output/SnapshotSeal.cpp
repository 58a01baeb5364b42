// SPDX-License-Identifier: BSD-3-Clause
#include "output/SnapshotSeal.hpp"

#include <xxhash.h>

#include <algorithm>
#include <cstdio>
#include <sstream>
#include <stdexcept>

#include "core/Error.hpp"

namespace gimdem::output
{

namespace
{

constexpr std::string_view first_words = "gimdem snapshot ";

std::string hash_of(void const* data, std::size_t size)
{
    char text[20];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(XXH3_64bits(data, size)));
    return text;
}

/// The seal from what it says; a pure function, so a seal is intact if it says what makes it.
std::string seal_text(std::string const& version, std::string const& kind, std::string const& size,
                      std::string const& hash)
{
    std::string text(first_words);
    text += version + "\nkind " + kind + "\nsize " + size + "\nxxh3 " + hash + '\n';
    text += "seal " + hash_of(text.data(), text.size()) + '\n';
    if (text.size() >= seal_size) throw std::invalid_argument("snapshot kind is too long: " + kind);
    text.resize(seal_size - 1, ' ');
    return text += '\n';
}

/// The words behind `key` on the next line.
std::string value_of(std::istream& lines, std::string_view key)
{
    std::string line;
    std::getline(lines, line);
    return line.starts_with(key) ? line.substr(key.size()) : "";
}

[[noreturn]] void refuse(std::filesystem::path const& file, std::string const& problem, std::string const& reason,
                         std::string const& advice)
{
    throw UserError("snapshot " + file.string() + ' ' + problem + " (" + reason + "); " + advice);
}

}  // namespace

std::string make_seal(int version, std::string const& kind, std::span<std::byte const> content)
{
    return seal_text(std::to_string(version), kind, std::to_string(content.size()),
                     hash_of(content.data(), content.size()));
}

void check_seal(std::span<std::byte const> bytes, int version, std::string const& kind,
                std::filesystem::path const& file)
{
    // A checkpoint is not made again.
    std::string const remove =
        kind == "checkpoint" ? "restart from another checkpoint" : "remove it, so that it is made again";
    std::string_view const all(reinterpret_cast<char const*>(bytes.data()), bytes.size());
    if (!all.starts_with(first_words.substr(0, std::min(all.size(), first_words.size()))))
        refuse(file, "is not a snapshot", "it does not begin with \"gimdem snapshot\"", "check the path");
    if (all.size() < seal_size)
        refuse(file, "is cut short", "it ends after " + std::to_string(all.size()) + " bytes", remove);

    std::string const found(all.substr(0, seal_size));
    std::istringstream lines(found);
    std::string const found_version = value_of(lines, first_words);
    std::string const found_kind = value_of(lines, "kind ");
    std::string const size = value_of(lines, "size ");
    std::string const hash = value_of(lines, "xxh3 ");
    if (seal_text(found_version, found_kind, size, hash) != found)
        refuse(file, "is damaged", "its first 512 bytes contradict themselves", remove);

    if (found_version != std::to_string(version))
        refuse(file, "has version " + found_version, "this program reads version " + std::to_string(version), remove);
    if (found_kind != kind)
        refuse(file, "is of the kind \"" + found_kind + '"', "\"" + kind + "\" is needed", "check the path");
    auto const content = bytes.subspan(seal_size);
    if (std::to_string(content.size()) != size)
        refuse(file, "is cut short", std::to_string(content.size()) + " bytes of " + size + " are there", remove);
    if (hash_of(content.data(), content.size()) != hash)
        refuse(file, "is damaged", "its checksum is not the one it was written with", remove);
}

}  // namespace gimdem::output
