// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>

#include <array>
#include <cstddef>
#include <cstdint>

/// Where in the user guide what a message, a dialog or a bar is about is explained. Docks have pages of their
/// own names.
namespace posewire::gui {

enum class HelpTopic : std::uint8_t {
    CannotListen,
    NoInput,
    NothingArrives,
    GroupNotJoined,
    TcpTrouble,
    NotMxtp,
    NoPose,
    NoPicture,
    EmptyFile,
    OpeningFailed,
    RecordingFailed,
    SavingFailed,
    NothingToExport,
    UnknownLayout,
    SettingsUnusable,
    HistoryOff,
    ViewNotKept,
    Inputs,
    Preferences,
    Thresholds,
    RecordingOptions,
    Replay,
    History,
    Recovered,
    MotionExport,
    SavePackets,
    PicturesExport,
    Viewport,
    TransportBar,
    VerdictBar,
    HealthBar,
    FirstSteps,
    Causes,
    Shortcuts,
    Protocol,
    Count
};

struct HelpTopicRow {
    HelpTopic topic;
    const char* place; ///< see openHelp()
};

inline constexpr std::array<HelpTopicRow, static_cast<std::size_t>(HelpTopic::Count)> kHelpTopics{{
    {HelpTopic::CannotListen, "messages#cannot-listen-on-a-port"},
    {HelpTopic::NoInput, "messages#nothing-to-listen-to"},
    {HelpTopic::NothingArrives, "messages#waiting-for-mxtp"},
    {HelpTopic::GroupNotJoined, "messages#a-multicast-group-cannot-be-joined"},
    {HelpTopic::TcpTrouble, "messages#tcp-no-connection-or-a-silent-one"},
    {HelpTopic::NotMxtp, "messages#these-datagrams-are-not-mxtp"},
    {HelpTopic::NoPose, "messages#datagrams-arrive-but-no-pose"},
    {HelpTopic::NoPicture, "messages#no-picture"},
    {HelpTopic::EmptyFile, "messages#no-character-in-a-recording"},
    {HelpTopic::OpeningFailed, "messages#a-file-cannot-be-opened"},
    {HelpTopic::RecordingFailed, "messages#a-recording-does-not-start-or-ends-by-itself"},
    {HelpTopic::SavingFailed, "messages#a-file-cannot-be-saved"},
    {HelpTopic::NothingToExport, "messages#there-is-nothing-to-export"},
    {HelpTopic::UnknownLayout, "messages#a-layout-is-not-known"},
    {HelpTopic::SettingsUnusable, "messages#settings-could-not-be-used"},
    {HelpTopic::HistoryOff, "messages#only-what-is-in-memory-can-be-looked-back-at"},
    {HelpTopic::ViewNotKept, "messages#no-view-is-kept"},
    {HelpTopic::Inputs, "network#inputs"},
    {HelpTopic::Preferences, "bars#preferences"},
    {HelpTopic::Thresholds, "bars#thresholds"},
    {HelpTopic::RecordingOptions, "recording#recording-options"},
    {HelpTopic::Replay, "recording#replay-to-the-network"},
    {HelpTopic::History, "recording#history-what-can-be-looked-back-at"},
    {HelpTopic::Recovered, "recording#recovered-packets"},
    {HelpTopic::MotionExport, "recording#export-motion"},
    {HelpTopic::SavePackets, "recording#save-packets"},
    {HelpTopic::PicturesExport, "recording#export-pictures"},
    {HelpTopic::Viewport, "viewport"},
    {HelpTopic::TransportBar, "bars#transport-bar"},
    {HelpTopic::VerdictBar, "bars#verdict-bar"},
    {HelpTopic::HealthBar, "bars#health-bar"},
    {HelpTopic::FirstSteps, "index#first-steps"},
    {HelpTopic::Causes, "causes"},
    {HelpTopic::Shortcuts, "shortcuts"},
    {HelpTopic::Protocol, "protocol"},
}};

[[nodiscard]] inline QString placeOf(HelpTopic topic) {
    return QLatin1String(kHelpTopics[static_cast<std::size_t>(topic)].place);
}

} // namespace posewire::gui
