// SPDX-License-Identifier: MIT
#include "core/log/recording.h"

#include "core/log/packet_log.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace posewire::log {
namespace {

constexpr std::chrono::milliseconds kPause{50};
constexpr std::chrono::seconds kSync{1};

} // namespace

Recorder::Recorder(const PacketLog& log, ByteSink& sink, std::uint64_t from)
    : m_sink(sink),
      m_timeline(log.timeline()),
      m_follower(LogFollower::fromOldest(log, from)),
      m_senders(log.senders()),
      m_writer(sink) {}

Recorder::Result Recorder::begin(const RecordingInfo& info) {
    const auto begun = m_writer.begin(info);
    return begun ? m_sink.flush() : begun;
}

Recorder::Result Recorder::follow() {
    const std::uint64_t before = m_writer.packets();
    const auto written = writeNew();
    return written && m_writer.packets() != before ? m_sink.flush() : written;
}

Recorder::Result Recorder::finish() {
    if (auto written = writeNew(); !written) {
        return written;
    }
    const auto ended = m_writer.finish();
    return ended ? m_sink.finish() : ended;
}

Recorder::Result Recorder::sync() {
    return std::exchange(m_synced, m_follower.position()) == m_follower.position() ? Result() : m_sink.sync();
}

Recorder::Result Recorder::writeNew() {
    m_follower.refresh();
    while (auto packet = m_follower.next()) {
        const std::uint64_t drops = packet->kernelDropsBefore + m_follower.takeOvertaken();
        packet->kernelDropsBefore =
            static_cast<std::uint32_t>(std::min<std::uint64_t>(drops, std::uint64_t{UINT32_MAX}));
        const SenderInfo* sender = m_senders.find(packet->sender);
        const Duration setBy = m_timeline.setByAt(packet->stamp);
        if (auto added = m_writer.add(*packet, sender != nullptr ? *sender : SenderInfo{}, {}, setBy);
            !added) {
            return added;
        }
    }
    return {};
}

tl::expected<std::unique_ptr<Recording>, FileError>
Recording::start(const PacketLog& log, const std::string& path, const RecordingInfo& info,
                 const OutputRules& rules, std::uint64_t from) {
    auto sink = createFile(path, rules);
    if (!sink) {
        return tl::unexpected(sink.error());
    }
    return start(log, std::move(*sink), info, from);
}

tl::expected<std::unique_ptr<Recording>, FileError> Recording::start(const PacketLog& log,
                                                                     std::unique_ptr<ByteSink> sink,
                                                                     const RecordingInfo& info,
                                                                     std::uint64_t from) {
    std::unique_ptr<Recording> recording(new Recording(log, std::move(sink), from));
    if (const auto begun = recording->m_recorder.begin(info); !begun) {
        return tl::unexpected(begun.error());
    }
    recording->m_thread = std::thread([raw = recording.get()] { raw->run(); });
    return recording;
}

Recording::Recording(const PacketLog& log, std::unique_ptr<ByteSink> sink, std::uint64_t from)
    : m_sink(std::move(sink)), m_recorder(log, *m_sink, from) {}

Recording::~Recording() {
    static_cast<void>(stop());
}

tl::expected<void, FileError> Recording::stop() {
    {
        const std::lock_guard lock(m_mutex);
        m_isStopping = true;
    }
    m_changed.notify_all();
    m_sink->hurry();
    if (m_thread.joinable()) {
        m_thread.join();
    }
    if (const auto why = failure()) {
        return tl::unexpected(*why);
    }
    return {};
}

RecordingFigures Recording::figures() const {
    const std::lock_guard lock(m_mutex);
    return m_figures;
}

std::optional<FileError> Recording::failure() const {
    const std::lock_guard lock(m_mutex);
    return m_failure;
}

void Recording::run() {
    bool isStopping = false;
    auto synced = std::chrono::steady_clock::now();
    while (!isStopping) {
        {
            std::unique_lock lock(m_mutex);
            isStopping = m_changed.wait_for(lock, kPause, [this] { return m_isStopping; });
        }
        if (!note(isStopping ? m_recorder.finish() : m_recorder.follow())) {
            return;
        }
        const auto now = std::chrono::steady_clock::now();
        if (!isStopping && now - synced >= kSync) {
            synced = now;
            if (!note(m_recorder.sync())) {
                return;
            }
        }
    }
}

/// False where nothing more can be written.
bool Recording::note(const Recorder::Result& result) {
    const std::lock_guard lock(m_mutex);
    m_figures = m_recorder.figures();
    if (!result) {
        m_failure = result.error();
    }
    return result.has_value();
}

} // namespace posewire::log
