// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/outlets/metric_families.h"

#include "core/model/session/accounts.h"
#include "core/model/session/listed_incidents.h"
#include "core/model/session/losses.h"
#include "core/model/session/roster.h"
#include "core/model/session/verdict.h"
#include "core/wire/type_table.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <iterator>
#include <map>
#include <string>
#include <utility>

namespace posewire::outlets {
namespace {

using prometheus::MetricFamily;
using prometheus::MetricType;
using Labels = std::vector<prometheus::ClientMetric::Label>;
using View = model::SessionView;
using model::Figure;
using State = model::TakeVerdict::State;

constexpr std::array<const char*, model::kLossCauses> kCauseLabels{"this_computer", "network", "sender",
                                                                   "unknown", "transport"};

/// Makes a counter if the name ends in _total, else a gauge.
MetricFamily family(std::string_view name, std::string_view help) {
    const bool isCounter = name.ends_with("_total");
    return {std::string(name), std::string(help), isCounter ? MetricType::Counter : MetricType::Gauge, {}};
}

template <class Number>
void add(MetricFamily& to, Number value, Labels labels = {}) {
    prometheus::ClientMetric& metric = to.metric.emplace_back();
    metric.label = std::move(labels);
    (to.type == MetricType::Counter ? metric.counter.value : metric.gauge.value) = static_cast<double>(value);
}

Labels with(Labels labels, std::string name, std::string_view value) {
    labels.push_back({std::move(name), std::string(value)});
    return labels;
}

/// A figure of the whole session.
struct SumRow {
    const char* name;
    const char* help;
    double (*read)(const View& session);
};

template <auto Member>
double ofAll(const View& session) {
    return static_cast<double>(session.accounts().allSenders().*Member);
}

using Sums = model::SenderTotals;
constexpr std::array kSums{
    SumRow{"posewire_updated_timestamp_seconds", "When these figures were read, in Unix time.",
           [](const View& session) {
               return std::chrono::duration<double>(session.wallOf(session.now()).time_since_epoch()).count();
           }},
    SumRow{"posewire_datagrams_total", "Datagrams received, of any content.", ofAll<&Sums::datagrams>},
    SumRow{"posewire_bytes_total", "Bytes of these datagrams.", ofAll<&Sums::bytes>},
    SumRow{"posewire_malformed_datagrams_total", "Datagrams that begin with MXTP and cannot be decoded.",
           ofAll<&Sums::malformed>},
    SumRow{"posewire_foreign_datagrams_total",
           "Datagrams that do not begin with MXTP: another program sends to this port.",
           ofAll<&Sums::foreign>},
    SumRow{"posewire_dropped_datagrams_total",
           "Datagrams that reached this computer and found its receive buffer full.",
           ofAll<&Sums::kernelDrops>},
    SumRow{"posewire_overtaken_packets_total",
           "Packets that were dropped from memory before this program processed them.",
           [](const View& session) { return static_cast<double>(session.accounts().overtaken()); }},
    SumRow{"posewire_senders", "Senders that are listed.",
           [](const View& session) { return static_cast<double>(session.roster().senders().size()); }},
    SumRow{"posewire_characters", "Characters that are listed.",
           [](const View& session) { return static_cast<double>(session.roster().listed().size()); }},
    SumRow{"posewire_retired_senders_total", "Senders that fell silent and made room for others.",
           [](const View& session) { return static_cast<double>(session.accounts().retired().senders); }},
    SumRow{"posewire_retired_lost_samples_total", "Samples that streams of these senders had lost.",
           [](const View& session) { return static_cast<double>(session.accounts().retired().lost); }}};

/// A figure of each stream.
struct StreamRow {
    Figure figure;
    const char* name;
    const char* help;
    double inBaseUnit = 1;
};
constexpr std::array kStreamRows{
    StreamRow{Figure::Datagrams, "posewire_stream_datagrams_total",
              "Datagrams of a stream that could be decoded, duplicates included."},
    StreamRow{Figure::Bytes, "posewire_stream_bytes_total", "Bytes of these datagrams."},
    StreamRow{Figure::Samples, "posewire_stream_samples_total", "Samples of a stream that arrived whole."},
    StreamRow{Figure::Rate, "posewire_stream_rate_hertz",
              "Samples per second over the newest 2 s; 0 if the stream is stale."},
    StreamRow{Figure::Jitter, "posewire_stream_jitter_seconds", "Interarrival jitter as in RFC 3550.", 1e-3}};

void addOwn(std::vector<MetricFamily>& families, const OwnFigures& own) {
    const auto addIfKnown = [&](std::string_view name, std::string_view help, const auto& value) {
        if (value) {
            add(families.emplace_back(family(name, help)), *value);
        }
    };
    addIfKnown("posewire_refused_datagrams_total", "Datagrams from hosts that are not listened to.",
               std::optional(own.refusedDatagrams));
    addIfKnown("posewire_receive_buffer_fill_ratio",
               "Peak fill of the fullest receive buffer since the last reading.", own.bufferFill);
    addIfKnown("process_cpu_seconds_total", "Processor time of all threads.", own.cpuSeconds);
    addIfKnown("process_resident_memory_bytes", "Main memory of this process.", own.memoryBytes);
}

/// One series for each state, of which one is 1.
void addStates(MetricFamily& to, State state, const Labels& labels) {
    for (const State one : {State::None, State::Good, State::Warning, State::Bad}) {
        add(to, one == state ? 1 : 0, with(labels, "state", model::nameOf(one)));
    }
}

void addCauses(MetricFamily& to, const model::LossesByCause& lost, const Labels& labels) {
    for (std::size_t cause = 0; cause < lost.size(); ++cause) {
        add(to, lost[cause], with(labels, "cause", kCauseLabels[cause]));
    }
}

MetricFamily incidents(const View& session) {
    using Stage = model::ListedIncident::State;
    using Severity = model::IncidentSeverity;
    std::map<std::pair<Severity, Stage>, std::uint64_t> counts;
    for (const model::Incident& incident : session.verdicts().incidents().all()) {
        counts[{incident.severity(), model::stateOf(session, incident)}] += model::isNote(incident) ? 0 : 1;
    }
    for (const model::ListedIncident& one : model::unsettledIncidents(session)) {
        ++counts[{one.incident.severity(), one.state}];
    }
    MetricFamily made = family("posewire_incidents",
                               "Incidents that are listed, by severity and state. Those that come to nothing "
                               "leave the list, and the oldest of very many.");
    for (const Severity severity : {Severity::Warning, Severity::Error}) { // Info is that of notes
        for (const Stage stage : {Stage::Provisional, Stage::Ongoing, Stage::Over}) {
            add(made, counts[{severity, stage}],
                {{"severity", severity == Severity::Error ? "error" : "warning"},
                 {"state", std::string(model::nameOf(stage))}});
        }
    }
    return made;
}

MetricFamily lostOfAll(const View& session, const model::Losses& losses) {
    model::LossesByCause lost{};
    for (const model::Stream& stream : session.roster().streams()) {
        losses.addTo(lost, stream);
    }
    MetricFamily made = family("posewire_lost_samples",
                               "Samples lost or incomplete of all listed senders, by cause, as is known now: "
                               "one that still comes is taken back.");
    addCauses(made, lost, {});
    return made;
}

Labels labelsOf(const View& session, const model::Sender& sender, const model::CharacterKey& key) {
    return {{"character", session.roster().displayName(key).shown()},
            {"id", std::to_string(key.character)},
            {"source", sender.address().shown()},
            {"transport", std::string(log::nameOf(sender.info.transport))},
            {"port", std::to_string(sender.info.localPort)}};
}

/// The families whose labels name characters and their streams.
class CharacterFamilies {
public:
    CharacterFamilies(const View& session, const model::Losses& losses)
        : m_session(session), m_losses(losses) {
        for (const StreamRow& row : kStreamRows) {
            m_figures.push_back(family(row.name, row.help));
        }
    }

    void add(const model::Character& character) {
        const model::Sender* sender = m_session.roster().find(character.key.sender);
        if (sender == nullptr) {
            return;
        }
        const Labels labels = labelsOf(m_session, *sender, character.key);
        addStates(m_verdicts, m_session.verdicts().of(character.key).state, labels);
        for (const model::Stream* stream : character.streams) {
            if (m_streams++ < kMostStreams) {
                add(*stream, with(labels, "type", wire::typeDigits(stream->key.type)));
            }
        }
    }

    void moveInto(std::vector<MetricFamily>& families) {
        families.push_back(std::move(m_verdicts));
        std::ranges::move(m_figures, std::back_inserter(families));
        families.push_back(std::move(m_lost));
        families.push_back(std::move(m_age));
    }

private:
    void add(const model::Stream& stream, const Labels& labels) {
        // As Losses::figuresOf has them, without the means and extremes that take most of its time.
        model::StreamFigures figures(stream.key, model::countedFigures(stream.accounting, {}));
        figures.set(Figure::Rate, stream.rateAt(m_session.now()));
        for (std::size_t i = 0; i < kStreamRows.size(); ++i) {
            const double value = figures[kStreamRows[i].figure];
            if (figures.has(kStreamRows[i].figure) && std::isfinite(value)) {
                outlets::add(m_figures[i], value * kStreamRows[i].inBaseUnit, labels);
            }
        }
        if (figures.has(Figure::LostUnknown)) {
            addCauses(m_lost, m_losses.of(stream).byCause, labels);
        }
        outlets::add(m_age, log::secondsOf(m_session.now() - stream.accounting.lastStamp()), labels);
    }

    const View& m_session;
    const model::Losses& m_losses;
    std::size_t m_streams = 0;
    MetricFamily m_verdicts =
        family("posewire_character_verdict", "1 for the state of a character's verdict, 0 for the others.");
    std::vector<MetricFamily> m_figures; ///< one for each of kStreamRows
    MetricFamily m_lost =
        family("posewire_stream_lost_samples", "Samples of a stream lost or incomplete, by cause, as is "
                                               "known now: one that still comes is taken back.");
    MetricFamily m_age = family("posewire_stream_age_seconds", "Time since the newest datagram of a stream.");
};

} // namespace

std::vector<MetricFamily> metricFamilies(const model::SessionView& view, const OwnFigures& own,
                                         std::string_view version) {
    const View& session = view.atNow();
    std::vector<MetricFamily> families;
    add(families.emplace_back(family("posewire_build_info", "The version of Posewire; always 1.")), 1,
        {{"version", std::string(version)}});
    for (const SumRow& row : kSums) {
        add(families.emplace_back(family(row.name, row.help)), row.read(session));
    }
    addOwn(families, own);
    addStates(families.emplace_back(
                  family("posewire_verdict", "1 for the state of the verdict on all, 0 for the others.")),
              session.verdicts().all().all.state, {});
    families.push_back(incidents(session));
    const model::Losses losses(session, {});
    families.push_back(lostOfAll(session, losses));
    CharacterFamilies ofCharacters(session, losses);
    std::vector<const model::Character*> listed = session.roster().listed();
    listed.resize(std::min(listed.size(), kMostCharacters));
    for (const model::Character* character : listed) {
        ofCharacters.add(*character);
    }
    ofCharacters.moveInto(families);
    return families;
}

} // namespace posewire::outlets
