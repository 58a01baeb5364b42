// SPDX-License-Identifier: BSD-3-Clause
/// Errors that a user can cause and mend.
#pragma once

#include <stdexcept>
#include <string>

namespace gimdem
{

/// Bad input or a run that cannot go on. what() reads: problem (why it is one); what to do.
class UserError : public std::runtime_error
{
    using std::runtime_error::runtime_error;
};

}  // namespace gimdem
