// SPDX-License-Identifier: BSD-3-Clause
#include "message/Message.hpp"

#include <gtest/gtest.h>

namespace gimdem::coupling::message
{
namespace
{

TEST(Printable, KeepsValidText)
{
    for (std::string const text :
         {"", "plain", "\xC3\xA9t\xC3\xA9", "\xE2\x82\xAC", "\xF0\x9F\x98\x80", "tab\tand\nline"})
        EXPECT_EQ(printable(text), text);
}

TEST(Printable, ReplacesWhatIsNotUtf8)
{
    EXPECT_EQ(printable("\xE9t\xE9"), "?t?") << "Latin-1";
    EXPECT_EQ(printable("\xC0\x80"), "??") << "overlong";
    EXPECT_EQ(printable("\xED\xA0\x80"), "???") << "surrogate";
    EXPECT_EQ(printable("\xF4\x90\x80\x80"), "????") << "beyond the last code point";
    EXPECT_EQ(printable("cut \xE2\x82"), "cut ??");
}

TEST(Printable, CutsWhatIsTooLong)
{
    std::string const text = printable(std::string(3 * max_text_bytes, 'x'));
    EXPECT_EQ(text.size(), max_text_bytes + 4);
    EXPECT_EQ(text.substr(max_text_bytes), " ...");
}

}  // namespace
}  // namespace gimdem::coupling::message
