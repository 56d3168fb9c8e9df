// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/help_topics.h"
#include "app/gui/base/program_state.h"
#include "app/gui/models/column.h"

#include <optional>
#include <vector>

namespace posewire::gui {

/// What the window hears: its inputs in the order in which they were added, named as MVN's Network Streamer
/// names them: protocol, host, port.
class InputModel : public TableModel<PortState> {
public:
    enum Column : int { kProtocol, kHost, kPort, kState, kRate, kDatagrams, kDropped, kRefused };

    InputModel();

    void refresh(const ReceivingState& receiving) { setRows(receiving.ports); }

    /// The input of a row; nothing outside.
    [[nodiscard]] std::optional<InputAddress> input(int row) const;
    [[nodiscard]] int rowOf(const InputAddress& input) const; ///< -1 where it is not
};

/// "listening", "connected from 10.0.0.5:50123", or what is wrong.
[[nodiscard]] PropertyValue inputState(const PortState& state);

/// The ways out, in the order in which they were added. Each is switched on and off by its box.
class WaysOutModel : public TableModel<WayOutState> {
    Q_OBJECT

public:
    enum Column : int { kTarget, kKind, kState, kSent, kRefused, kSkipped, kBehind };

    WaysOutModel();

    void refresh(const std::vector<WayOutState>& ways) { setRows(ways); }

    [[nodiscard]] bool setData(const QModelIndex& index, const QVariant& value, int role) override;
    [[nodiscard]] Qt::ItemFlags flags(const QModelIndex& index) const override;

signals:
    /// The operator has switched one; the row changes with the next refresh().
    void switched(int row, bool isOn);
};

/// "forwarding", "2 connected", "off", or why not.
[[nodiscard]] PropertyValue wayOutStage(const WayOutState& way);

/// Why no characters are seen, and what to do about it, each a sentence.
struct Advice {
    Health level;
    QString text;
    QString remedy;
    std::optional<HelpTopic> topic{};
    bool isCertain = false;              ///< known of an input, not inferred from silence
    std::optional<InputAddress> offer{}; ///< an input that is not open, and would show it
};
[[nodiscard]] std::vector<Advice> adviceOn(const ReceivingState& receiving);

} // namespace posewire::gui
