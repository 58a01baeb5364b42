// SPDX-License-Identifier: BSD-3-Clause
/// Folders of keys, with which a server and its clients know each other and encrypt what they say: docs/security.md.
///
///     DIR/server.secret          the server's pair of keys        server
///     DIR/clients/NAME.public    a client that may come in        server
///     DIR/server.public          the server that a client trusts  client
///     DIR/client.secret          the client's pair of keys        client
#pragma once

#include <string>

namespace gimdem::coupling
{

/// Makes a new folder with keys for a server and a client, which is then one of its clients; every file is of mode
/// 0600. Fault::user if the folder has keys already.
void make_keys(std::string const& folder);

}  // namespace gimdem::coupling
