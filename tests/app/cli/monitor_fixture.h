// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/log/output_file.h"
#include "core/log/pcapng_writer.h"
#include "core/log/time.h"
#include "core/wire/codec.h"
#include "tests/app/cli/program_run.h"

#include <nlohmann/json.hpp>

namespace posewire::cli::test {

/// Makes a recording packet by packet.
class RecordingFile {
public:
    RecordingFile()
        : m_path(fileWith("")),
          m_sink(log::createFile(m_path, {.mayReplace = true}).value()),
          m_writer(*m_sink) {
        static_cast<void>(m_writer.begin({}));
    }

    void add(const std::vector<std::byte>& bytes, log::Stamp stamp,
             const log::SenderInfo& sender = {"10.0.0.2:40001", log::Transport::Udp, 9763},
             std::uint32_t drops = 0, log::PacketFlags flags = {.stampedByKernel = true}) {
        static_cast<void>(m_writer.add({0, stamp, {}, drops, flags, bytes}, sender));
    }
    /// A pose of one segment, 240 a second from stamp 1,700,000,000 s on.
    void addPose(std::uint32_t sample, std::uint8_t character = 0) {
        add(pose(sample, character), kStart + sample * log::Duration(std::chrono::seconds(1)) / 240);
    }
    /// Ends the file; its path.
    std::string finish() {
        static_cast<void>(m_writer.addStatistics());
        static_cast<void>(m_sink->flush());
        return m_path;
    }

    static std::vector<std::byte> pose(std::uint32_t sample, std::uint8_t character = 0) {
        wire::Datagram datagram;
        datagram.header.sampleCounter = sample;
        datagram.header.character = character;
        datagram.header.timeCode = sample * 1000 / 240;
        wire::PoseQuaternion body;
        body.segments.push_back({1, {0, 0, 1}, {1, 0, 0, 0}});
        datagram.body = body;
        wire::completeHeader(datagram, wire::HeaderEra::Counted);
        return wire::encode(datagram).value();
    }
    static std::vector<std::byte> metadata(const std::string& name) {
        wire::Datagram datagram;
        wire::MetaData body;
        body.text = "name:" + name + "\n";
        datagram.body = body;
        wire::completeHeader(datagram, wire::HeaderEra::Counted);
        return wire::encode(datagram).value();
    }

    static constexpr log::Stamp kStart{std::chrono::seconds(1'700'000'000)};

private:
    std::string m_path;
    std::unique_ptr<log::ByteSink> m_sink;
    log::PcapngWriter m_writer;
};

using Json = nlohmann::ordered_json;

inline Json reportOf(const std::string& path, std::vector<std::string> more = {}) {
    more.insert(more.begin(), {"monitor", path, "--json"});
    const ProgramRun run = runProgram(more);
    return Json::parse(run.out, nullptr, false);
}

inline std::vector<std::string> keysOf(const Json& object) {
    std::vector<std::string> keys;
    for (const auto& [key, value] : object.items()) {
        keys.push_back(key);
    }
    return keys;
}

} // namespace posewire::cli::test
