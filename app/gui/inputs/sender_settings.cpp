// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/inputs/sender_settings.h"

#include "app/gui/theme/theme.h"
#include "app/gui/theme/widgets.h"

#include <QGridLayout>
#include <QLabel>
#include <QToolButton>

#include <algorithm>
#include <iterator>

namespace posewire::gui {

namespace {

/// More addresses than this help nobody.
constexpr std::size_t kMostHosts = 4;
constexpr int kFirstHostRow = 3;

QLabel* valueLabel(QWidget* parent) {
    auto* label = new QLabel(parent);
    label->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
    label->setFont(monospaceFont());
    return label;
}

} // namespace

std::vector<net::LocalAddress> hostsFor(const InputAddress& input,
                                        const std::vector<net::LocalAddress>& addresses) {
    std::vector<net::LocalAddress> hosts;
    for (const QString& group : input.groups) {
        hosts.push_back({group.toStdString(), "", true, false, false});
    }
    if (!hosts.empty()) {
        return hosts;
    }
    if (input.address.isEmpty()) {
        const bool hasOther =
            std::ranges::any_of(addresses, [](const net::LocalAddress& each) { return !each.isLinkLocal; });
        std::ranges::copy_if(addresses, std::back_inserter(hosts),
                             [&](const net::LocalAddress& each) { return !hasOther || !each.isLinkLocal; });
        hosts.resize(std::min(hosts.size(), kMostHosts));
        return hosts;
    }
    const std::string own = input.address.toStdString();
    const auto known = std::ranges::find(addresses, own, &net::LocalAddress::address);
    return {known == addresses.end() ? net::LocalAddress{own, "", true, false, false} : *known};
}

SenderSettings::SenderSettings(QWidget* parent)
    : QWidget(parent),
      m_grid(new QGridLayout(this)),
      m_title(new QLabel(this)),
      m_portTitle(dimLabel(tr("Port"), this)),
      m_port(valueLabel(this)),
      m_protocolTitle(dimLabel(tr("Protocol"), this)),
      m_protocol(valueLabel(this)) {
    m_title->setWordWrap(true);
    m_grid->setContentsMargins(0, 0, 0, 0);
    m_grid->setHorizontalSpacing(fontMetrics().height());
    m_grid->setColumnStretch(3, 1);
    m_grid->addWidget(m_title, 0, 0, 1, 4);
    m_grid->addWidget(m_protocolTitle, 1, 0);
    m_grid->addWidget(m_protocol, 1, 1);
    m_grid->addWidget(m_portTitle, 2, 0);
    m_grid->addWidget(m_port, 2, 1);
    m_grid->addWidget(dimLabel(tr("Host"), this), kFirstHostRow, 0);
}

void SenderSettings::addHostRow() {
    const int row = kFirstHostRow + static_cast<int>(m_rows.size());
    HostRow widgets{valueLabel(this), dimLabel({}, this), new QToolButton(this)};
    widgets.copy->setText(tr("Copy"));
    widgets.copy->setProperty("framed", true);
    m_grid->addWidget(widgets.host, row, 1);
    m_grid->addWidget(widgets.copy, row, 2);
    m_grid->addWidget(widgets.interface, row, 3);
    connect(widgets.copy, &QToolButton::clicked, this,
            [this, host = widgets.host] { emit copyRequested(host->text()); });
    m_rows.push_back(widgets);
}

void SenderSettings::setHosts(const std::vector<net::LocalAddress>& hosts) {
    while (m_rows.size() < hosts.size()) {
        addHostRow();
    }
    for (std::size_t i = 0; i < m_rows.size(); ++i) {
        const bool isShown = i < hosts.size();
        for (QWidget* widget :
             {static_cast<QWidget*>(m_rows[i].host), static_cast<QWidget*>(m_rows[i].interface),
              static_cast<QWidget*>(m_rows[i].copy)}) {
            widget->setVisible(isShown);
        }
        if (isShown) {
            const QString host = QString::fromStdString(hosts[i].address);
            if (host != m_rows[i].host->text()) { // else a selection in it would be lost
                m_rows[i].host->setText(host);
                m_rows[i].copy->setAccessibleName(tr("Copy %1").arg(host));
            }
            m_rows[i].interface->setText(QString::fromStdString(hosts[i].interface));
        }
    }
}

void SenderSettings::showFor(const InputAddress& input, const std::vector<net::LocalAddress>& addresses) {
    const bool isOutgoing = input.kind == InputAddress::Kind::TcpConnect;
    const auto hosts = isOutgoing ? std::vector<net::LocalAddress>{} : hostsFor(input, addresses);
    m_title->setText(isOutgoing
                         ? tr("This input connects to %1, which has to listen there. There is nothing to "
                              "enter in MVN: it makes connections itself, and needs an input that listens.")
                               .arg(input.address)
                         : tr("Enter in MVN, under Options > Preferences > Network Streamer:"));
    for (QLabel* label : findChildren<QLabel*>(QString(), Qt::FindDirectChildrenOnly)) {
        label->setVisible(label == m_title || !isOutgoing);
    }
    setHosts(hosts);
    m_port->setText(QString::number(input.port));
    m_protocol->setText(input.kind == InputAddress::Kind::Udp ? tr("UDP") : tr("TCP"));
}

QStringList SenderSettings::hosts() const {
    QStringList hosts;
    for (const HostRow& row : m_rows) {
        if (!row.host->isHidden()) {
            hosts += row.host->text();
        }
    }
    return hosts;
}

} // namespace posewire::gui
