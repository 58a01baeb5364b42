// SPDX-License-Identifier: BSD-3-Clause
#include "transport/Keys.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <array>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>

#include <zmq.hpp>

#include "gimdem/coupling/Error.hpp"
#include "gimdem/coupling/Keys.hpp"

namespace gimdem::coupling::transport
{
namespace
{

namespace fs = std::filesystem;

std::size_t constexpr key_length = 40;  ///< of z85 text, without the closing zero

[[noreturn]] void refuse(fs::path const& file, std::string const& why)
{
    throw CouplingError(Fault::user, "key file " + file.string() + " " + why);
}

/// Like ssh: a secret that others can read is none, and whom we trust is not for others to write.
void check_mode(fs::path const& file, bool secret)
{
    struct stat status = {};
    if (::stat(file.c_str(), &status) != 0)
        refuse(file, "cannot be opened (" + std::generic_category().message(errno) +
                         "); make keys with ./gimdem keys DIR, or see docs/security.md");
    if (status.st_uid != ::geteuid() && status.st_uid != 0)
        refuse(file, "belongs to another user (who could read and change it); copy it");
    mode_t const forbidden = secret ? S_IRWXG | S_IRWXO : S_IWGRP | S_IWOTH;
    if ((status.st_mode & forbidden) == 0) return;
    refuse(file, std::string("can be ") + (secret ? "read" : "written") +
                     " by other users (then its key proves nothing); run chmod 600 " + file.string());
}

bool is_key(std::string const& text)
{
    std::array<unsigned char, 32> binary{};
    return text.size() == key_length && zmq_z85_decode(binary.data(), text.c_str()) != nullptr;
}

/// The value of a line `name = "value"`. Lines that begin with # are comments.
std::string read_key(fs::path const& file, std::string const& name)
{
    std::ifstream stream(file);
    std::string const start = name + " = \"";
    for (std::string line; std::getline(stream, line);)
    {
        if (line.rfind(start, 0) != 0 || line.back() != '"') continue;
        std::string const key = line.substr(start.size(), line.size() - start.size() - 1);
        if (is_key(key)) return key;
    }
    refuse(file, "has no line " + name + " = \"...\" with a key of 40 characters; see docs/security.md");
}

KeyPair read_pair(fs::path const& file)
{
    check_mode(file, true);
    KeyPair pair{read_key(file, "public"), read_key(file, "secret")};
    std::array<char, key_length + 1> derived{};
    if (zmq_curve_public(derived.data(), pair.secret_key.c_str()) != 0 || pair.public_key != derived.data())
        refuse(file, "has a public key that does not belong to its secret key; make the keys anew");
    return pair;
}

std::string read_public(fs::path const& file)
{
    check_mode(file, false);
    return read_key(file, "public");
}

/// Fails if the file is there already.
void write_new(fs::path const& file, std::string const& text)
{
    int const descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, S_IRUSR | S_IWUSR);
    bool const opened = descriptor >= 0;
    bool const written = opened && ::write(descriptor, text.data(), text.size()) == static_cast<ssize_t>(text.size()) &&
                         ::fsync(descriptor) == 0;
    int const error = errno;
    if (opened) ::close(descriptor);
    if (!written) refuse(file, "cannot be made (" + std::generic_category().message(error) + "); choose a new folder");
}

std::string secret_text(KeyPair const& pair, std::string const& whose)
{
    return "# gimdem: keys of a " + whose + ". Keep this file secret: who reads it can pass for that " + whose +
           ".\npublic = \"" + pair.public_key + "\"\nsecret = \"" + pair.secret_key + "\"\n";
}

std::string public_text(KeyPair const& pair, std::string const& purpose)
{
    return "# gimdem: public key of " + purpose + ".\npublic = \"" + pair.public_key + "\"\n";
}

}  // namespace

KeyPair make_key_pair()
{
    std::array<char, key_length + 1> public_key{};
    std::array<char, key_length + 1> secret_key{};
    if (zmq_curve_keypair(public_key.data(), secret_key.data()) != 0)
        throw CouplingError(Fault::user, "no keys can be made (this libzmq was built without CURVE); install Debian's");
    return {public_key.data(), secret_key.data()};
}

ServerKeys read_server_keys(std::string const& folder)
{
    ServerKeys keys{read_pair(fs::path(folder) / "server.secret"), {}};
    fs::path const clients = fs::path(folder) / "clients";
    check_mode(clients, false);
    for (auto const& entry : fs::directory_iterator(clients))
        if (entry.path().extension() == ".public") keys.clients.push_back(read_public(entry.path()));
    if (keys.clients.empty())
        refuse(clients, "holds no client's key (so nobody could come in); put a file NAME.public into it");
    return keys;
}

ClientKeys read_client_keys(std::string const& folder)
{
    return {read_pair(fs::path(folder) / "client.secret"), read_public(fs::path(folder) / "server.public")};
}

}  // namespace gimdem::coupling::transport

void gimdem::coupling::make_keys(std::string const& folder)
{
    namespace fs = std::filesystem;
    using namespace transport;
    fs::path const place(folder);
    for (char const* const name : {"server.secret", "server.public", "client.secret", "clients"})
        if (fs::exists(place / name))
            throw CouplingError(Fault::user, place.string() + " holds keys already (" + name +
                                                 "; whoever uses them would be locked out); choose another folder");
    std::error_code error;
    fs::create_directories(place / "clients", error);
    if (error) refuse(place, "cannot be made (" + error.message() + "); choose another folder");
    fs::permissions(place, fs::perms::owner_all, error);

    KeyPair const server = make_key_pair();
    KeyPair const client = make_key_pair();
    write_new(place / "server.secret", secret_text(server, "server"));
    write_new(place / "server.public", public_text(server, "the server that this client trusts"));
    write_new(place / "client.secret", secret_text(client, "client"));
    write_new(place / "clients" / "client.public", public_text(client, "a client that this server lets in"));
}
