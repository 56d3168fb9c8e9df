// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/port_holder.h"

#include "core/log/file_names.h"

#include <array>
#include <filesystem>
#include <vector>

#include <winsock2.h>
#include <ws2tcpip.h>

#include <iphlpapi.h>
#include <windows.h>

namespace posewire::net {
namespace {

/// The system's table of that kind; empty if it gives none.
template <class Ask>
std::vector<std::byte> tableOf(Ask ask) {
    std::vector<std::byte> bytes(std::size_t{16} << 10);
    for (int attempts = 0; attempts < 3; ++attempts) { // it may grow meanwhile
        auto size = static_cast<DWORD>(bytes.size());
        const DWORD result = ask(bytes.data(), &size);
        if (result == NO_ERROR) {
            return bytes;
        }
        if (result != ERROR_INSUFFICIENT_BUFFER) {
            break;
        }
        bytes.resize(size);
    }
    return {};
}

/// The process of the first row with that port; 0 if there is none.
template <class Table>
DWORD processIn(const std::vector<std::byte>& bytes, std::uint16_t port) {
    if (bytes.empty()) {
        return 0;
    }
    const auto* table = reinterpret_cast<const Table*>(bytes.data());
    for (DWORD i = 0; i < table->dwNumEntries; ++i) {
        if (::ntohs(static_cast<u_short>(table->table[i].dwLocalPort)) == port) {
            return table->table[i].dwOwningPid;
        }
    }
    return 0;
}

DWORD processAt(std::uint16_t port, bool isTcp, ULONG family) {
    const auto bytes = tableOf([&](void* into, DWORD* size) {
        return isTcp ? ::GetExtendedTcpTable(into, size, FALSE, family, TCP_TABLE_OWNER_PID_LISTENER, 0)
                     : ::GetExtendedUdpTable(into, size, FALSE, family, UDP_TABLE_OWNER_PID, 0);
    });
    if (family == AF_INET) {
        return isTcp ? processIn<MIB_TCPTABLE_OWNER_PID>(bytes, port)
                     : processIn<MIB_UDPTABLE_OWNER_PID>(bytes, port);
    }
    return isTcp ? processIn<MIB_TCP6TABLE_OWNER_PID>(bytes, port)
                 : processIn<MIB_UDP6TABLE_OWNER_PID>(bytes, port);
}

/// "mvn" of C:\\Program Files\\...\\mvn.exe; empty if the process may not be asked.
std::string nameOf(DWORD process) {
    const HANDLE handle = ::OpenProcess(PROCESS_QUERY_LIMITED_INFORMATION, FALSE, process);
    if (handle == nullptr) {
        return {};
    }
    std::array<wchar_t, 1024> path{};
    auto length = static_cast<DWORD>(path.size());
    const bool isKnown = ::QueryFullProcessImageNameW(handle, 0, path.data(), &length) != FALSE;
    ::CloseHandle(handle);
    return isKnown ? log::nameOf(std::filesystem::path(path.data(), path.data() + length).stem())
                   : std::string();
}

} // namespace

std::optional<Process> holderOfPort(std::uint16_t port, bool isTcp) {
    for (const ULONG family : {ULONG{AF_INET}, ULONG{AF_INET6}}) {
        if (const DWORD process = processAt(port, isTcp, family); process != 0) {
            const std::string name = nameOf(process);
            return Process{name.empty() ? "another program" : name, static_cast<std::int64_t>(process)};
        }
    }
    return std::nullopt;
}

} // namespace posewire::net
