// SPDX-License-Identifier: BSD-3-Clause
/// Words of OpenFOAM's text files, one after the other.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "exec/Vector.hpp"

namespace gimdem::test
{

/// One file, read from its header on. All members throw UserError, with file and line, where the text is something
/// else.
class FoamText
{
public:
    /// Opens the file and passes its header FoamFile { ... }, which must not say "format binary".
    explicit FoamText(std::filesystem::path const& file);

    std::string_view next();  ///< the next word, or one of ( ) { } ;
    void expect(std::string_view word);
    bool skip(std::string_view word);  ///< true, and passed, if this is next
    int integer();
    double number();
    Vec3 vector();                ///< (x y z)
    std::vector<int> integers();  ///< 3(4 5 6), 3{4}: three times 4, or 3(...) over several lines

    [[noreturn]] void fail(std::string_view what) const;

private:
    void skip_space();
    std::string_view look();
    template <class Number>
    Number parse(std::string_view what);

    std::filesystem::path file_;
    std::string text_;
    std::size_t at_ = 0;
};

}  // namespace gimdem::test
