// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/monitor_run.h"
#include "core/log/recording.h"

#include <QCoreApplication>

#include <algorithm>
#include <array>

namespace posewire::cli {
namespace {

net::NetResult<void> open(net::Receiver& receiver, const MonitorPlaces& places) {
    for (const net::UdpInput& input : places.udp) {
        if (const auto added = receiver.addUdp(input); !added) {
            return tl::unexpected(added.error());
        }
    }
    for (const net::Endpoint& endpoint : places.tcpListen) {
        if (const auto added = receiver.addTcpListener(endpoint); !added) {
            return tl::unexpected(added.error());
        }
    }
    for (const net::Endpoint& endpoint : places.tcp) {
        receiver.addTcpConnection(endpoint);
    }
    return {};
}

/// Tells at once where a recording has failed, and only once.
class RecordingWatch {
public:
    RecordingWatch(std::unique_ptr<log::Recording> recording, Console& console)
        : m_recording(std::move(recording)), m_console(console) {}

    void look() {
        if (m_recording && m_status == ExitStatus::Fine) {
            note(m_recording->failure());
        }
    }
    ExitStatus stop() {
        if (m_recording && m_status == ExitStatus::Fine) {
            const auto stopped = m_recording->stop();
            note(stopped ? std::nullopt : std::optional(stopped.error()));
            if (const std::uint64_t missed = m_recording->figures().missed; missed != 0) {
                m_console.complain(std::to_string(missed) +
                                   " packets came faster than the disk could take them and are not in the "
                                   "recording; choose a faster disk");
                m_status = worse(m_status, ExitStatus::Faults);
            }
        }
        return m_status;
    }

private:
    void note(const std::optional<log::FileError>& failure) {
        if (failure) {
            m_console.complain(failure->text);
            m_status = ExitStatus::Unusable;
        }
    }

    std::unique_ptr<log::Recording> m_recording;
    Console& m_console;
    ExitStatus m_status = ExitStatus::Fine;
};

/// Until the time is over or nobody wants more. Returns how long it was.
double watch(const MonitorOptions& options, MonitorRun& run, RecordingWatch& recording) {
    using namespace std::chrono;
    constexpr duration<double> pause{0.05};
    const log::SystemClock clock;
    const auto start = steady_clock::now();
    while (true) {
        const duration<double> elapsed = steady_clock::now() - start;
        const duration<double> left{options.durationSeconds - elapsed.count()};
        const bool hasEnd = options.durationSeconds > 0;
        run.follow(clock.wall());
        run.show(elapsed.count());
        recording.look();
        if (run.isOver() || (hasEnd && left.count() <= 0)) {
            return elapsed.count();
        }
        std::this_thread::sleep_for(hasEnd ? std::min(pause, left) : pause);
    }
}

} // namespace

ExitStatus monitorNetwork(const MonitorOptions& options, Console& console) {
    const auto unusable = [&](const std::string& complaint) { return console.unusable(complaint); };
    const auto places = placesOf(options);
    if (!places) {
        return unusable(places.error());
    }
    // Qt's sockets want an application to be there.
    std::string name = "posewire-cli";
    std::array<char*, 2> arguments{name.data(), nullptr};
    int argumentCount = 1;
    const QCoreApplication application(argumentCount, arguments.data());

    const log::SystemClock clock;
    MonitorRun run(options, console);
    std::unique_ptr<log::Recording> recording;
    if (!options.record.empty()) {
        auto started = log::Recording::start(run.log(), options.record, recordingInfo());
        if (!started) {
            return unusable(started.error().text);
        }
        recording = std::move(*started);
    }
    auto receiver = std::make_unique<net::Receiver>(run.log(), clock);
    if (const auto opened = open(*receiver, *places); !opened) {
        return unusable(opened.error().text);
    }
    RecordingWatch recordingWatch(std::move(recording), console);
    exporting::MonitorFacts facts;
    facts.durationS = watch(options, run, recordingWatch);
    facts.receiveBufferBytes = receiver->totals().receiveBufferBytes;
    receiver.reset(); // what is in the sockets still comes into the log
    run.follow(clock.wall());
    return run.conclude(facts, recordingWatch.stop());
}

} // namespace posewire::cli
