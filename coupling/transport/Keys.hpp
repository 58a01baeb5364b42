// SPDX-License-Identifier: BSD-3-Clause
/// What the files of keys hold. All keys are 40 characters of z85 text (ZeroMQ RFC 32).
#pragma once

#include <string>
#include <vector>

namespace gimdem::coupling::transport
{

/// A Curve25519 pair.
struct KeyPair
{
    std::string public_key;
    std::string secret_key;
};

/// What a server needs: who it is, and whom it lets in.
struct ServerKeys
{
    KeyPair own;
    std::vector<std::string> clients;  ///< public keys
};

/// What a client needs: who it is, and whom it trusts.
struct ClientKeys
{
    KeyPair own;
    std::string server;  ///< public key
};

KeyPair make_key_pair();

/// Read a folder of keys, gimdem/coupling/Keys.hpp. Fault::user if a file is absent or wrong, if a secret one can be
/// read by anybody but its owner, or if a public one can be written by others.
ServerKeys read_server_keys(std::string const& folder);
ClientKeys read_client_keys(std::string const& folder);

}  // namespace gimdem::coupling::transport
