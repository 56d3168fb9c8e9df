// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/mvnx/xml_reader.h"

#include <algorithm>

namespace posewire::mvnx {
namespace {

std::string withoutPrefix(QStringView name) {
    return name.mid(name.lastIndexOf(QLatin1Char(':')) + 1).toUtf8().toStdString();
}

} // namespace

tl::expected<XmlReader::Event, log::FileError> XmlReader::next() {
    m_text.clear();
    while (true) {
        const QXmlStreamReader::TokenType token = m_xml.readNext();
        if (token == QXmlStreamReader::Invalid) {
            if (m_xml.error() != QXmlStreamReader::PrematureEndOfDocumentError) {
                return tl::unexpected(damage(m_xml.errorString().toStdString()));
            }
            if (const auto more = readMore(); !more) {
                return tl::unexpected(more.error());
            }
            continue;
        }
        m_fed = 0;
        if (token == QXmlStreamReader::EndDocument) {
            return Event::EndOfFile;
        }
        if (token == QXmlStreamReader::StartElement) {
            if (++m_depth > kDeepest) {
                return tl::unexpected(
                    damage("elements more than " + std::to_string(kDeepest) + " deep in each other"));
            }
            m_name = withoutPrefix(m_xml.qualifiedName());
            m_attributes.clear();
            for (const QXmlStreamAttribute& one : m_xml.attributes()) {
                m_attributes.emplace_back(withoutPrefix(one.qualifiedName()),
                                          one.value().toUtf8().toStdString());
            }
            return Event::Begin;
        }
        if (token == QXmlStreamReader::EndElement) {
            --m_depth;
            m_name = withoutPrefix(m_xml.qualifiedName());
            return Event::End;
        }
        if (token == QXmlStreamReader::DTD && !m_xml.entityDeclarations().isEmpty()) {
            return tl::unexpected(
                damage("a document type with entities of its own, which MVNX does not have"));
        }
        if (token == QXmlStreamReader::Characters) {
            m_text += m_xml.text().toUtf8().toStdString();
            if (m_text.size() > kLongest) {
                return tl::unexpected(damage("a text that is too long"));
            }
        }
    }
}

tl::expected<void, log::FileError> XmlReader::readMore() {
    const auto count = m_source.read(m_buffer);
    if (!count) {
        return tl::unexpected(count.error());
    }
    if (*count == 0) {
        return tl::unexpected(log::FileError{m_source.name() + ": is cut off: it ends in line " +
                                                 std::to_string(m_xml.lineNumber()) + " amidst an element",
                                             log::FileError::Kind::Cut});
    }
    m_fed += *count;
    if (m_fed > kLongest) {
        return tl::unexpected(damage("a tag or a text that is too long"));
    }
    m_xml.addData(QByteArray(reinterpret_cast<const char*>(m_buffer.data()), static_cast<qsizetype>(*count)));
    return {};
}

std::string_view XmlReader::attribute(std::string_view name) const {
    const auto found = std::find_if(m_attributes.begin(), m_attributes.end(),
                                    [name](const auto& attribute) { return attribute.first == name; });
    return found == m_attributes.end() ? std::string_view() : found->second;
}

log::FileError XmlReader::damage(const std::string& problem) const {
    return {m_source.name() + ": line " + std::to_string(m_xml.lineNumber()) + ": " + problem +
                "; export the file from MVN again",
            log::FileError::Kind::Damaged};
}

} // namespace posewire::mvnx
