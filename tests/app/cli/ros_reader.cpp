// SPDX-License-Identifier: GPL-3.0-or-later
// Prints /tf and /joint_states of a domain, a line of JSON for each message, as a program of ROS 2 reads
// them: by Fast DDS, its usual middleware, which shares nothing with the one that Posewire writes by. usage:
// ros_reader DOMAIN    (ends when its standard output does)
#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace {

using namespace eprosima;
using namespace eprosima::fastdds::dds;

std::string headerOf(fastcdr::Cdr& from) {
    std::int32_t seconds = 0;
    std::uint32_t nanoseconds = 0;
    std::string frame;
    from >> seconds >> nanoseconds >> frame;
    return "\"stamp\":[" + std::to_string(seconds) + ',' + std::to_string(nanoseconds) + "],\"frame\":\"" +
           frame + '"';
}

std::string transformsOf(fastcdr::Cdr& from) {
    std::uint32_t count = 0;
    from >> count;
    std::string text = "{\"tf\":[";
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::string header = headerOf(from);
        std::string child;
        std::array<double, 7> numbers{};
        from >> child;
        for (double& number : numbers) {
            from >> number;
        }
        text += (i == 0 ? "{" : ",{") + header + ",\"child\":\"" + child + "\",\"transform\":[";
        for (std::size_t k = 0; k < numbers.size(); ++k) {
            text += (k == 0 ? "" : ",") + std::to_string(numbers[k]);
        }
        text += "]}";
    }
    return text + "]}";
}

std::string jointsOf(fastcdr::Cdr& from) {
    const std::string header = headerOf(from);
    std::vector<std::string> names;
    std::vector<double> positions;
    std::vector<double> velocities;
    std::vector<double> efforts;
    from >> names >> positions >> velocities >> efforts;
    std::string text = "{\"joints\":{";
    for (std::size_t i = 0; i < names.size(); ++i) {
        text += (i == 0 ? "\"" : ",\"") + names[i] + "\":" + std::to_string(positions.at(i));
    }
    return text + "}," + header + ",\"others\":" + std::to_string(velocities.size() + efforts.size()) + '}';
}

/// A type that is read as JSON, and never written.
class Read final : public TopicDataType {
public:
    Read(const char* name, std::string (*read)(fastcdr::Cdr&)) : m_read(read) {
        setName(name);
        m_typeSize = 1 << 20;
    }
    bool serialize(void* /*data*/, fastrtps::rtps::SerializedPayload_t* /*payload*/) override {
        return false;
    }
    bool deserialize(fastrtps::rtps::SerializedPayload_t* payload, void* data) override {
        fastcdr::FastBuffer buffer(reinterpret_cast<char*>(payload->data), payload->length);
        fastcdr::Cdr from(buffer, fastcdr::Cdr::DEFAULT_ENDIAN, fastcdr::Cdr::DDS_CDR);
        from.read_encapsulation();
        *static_cast<std::string*>(data) = m_read(from);
        return true;
    }
    std::function<std::uint32_t()> getSerializedSizeProvider(void* /*data*/) override {
        return [] { return 0U; };
    }
    void* createData() override { return new std::string; }
    void deleteData(void* data) override { delete static_cast<std::string*>(data); }
    bool getKey(void* /*data*/, fastrtps::rtps::InstanceHandle_t* /*key*/, bool /*isMd5*/) override {
        return false;
    }

private:
    std::string (*m_read)(fastcdr::Cdr&);
};

} // namespace

int main(int, char** arguments) {
    // Without multicast and beyond this computer, so that the test needs no network.
    DomainParticipantQos local = PARTICIPANT_QOS_DEFAULT;
    const auto loopback = std::make_shared<fastdds::rtps::UDPv4TransportDescriptor>();
    loopback->interfaceWhiteList.emplace_back("127.0.0.1");
    local.transport().user_transports.push_back(loopback);
    local.transport().use_builtin_transports = false;
    fastrtps::rtps::Locator_t peer;
    fastrtps::rtps::IPLocator::setIPv4(peer, "127.0.0.1");
    local.wire_protocol().builtin.initialPeersList.push_back(peer);
    DomainParticipant* participant = DomainParticipantFactory::get_instance()->create_participant(
        static_cast<std::uint32_t>(std::atoi(arguments[1])), local);
    Subscriber* subscriber = participant->create_subscriber(SUBSCRIBER_QOS_DEFAULT);
    DataReaderQos qos = DATAREADER_QOS_DEFAULT; // as `ros2 topic echo`
    qos.reliability().kind = RELIABLE_RELIABILITY_QOS;
    qos.history().depth = 100; // as programs that listen to /tf: several characters come at once
    std::vector<DataReader*> readers;
    for (const auto& [topic, type, read] :
         {std::tuple{"rt/tf", "tf2_msgs::msg::dds_::TFMessage_", &transformsOf},
          std::tuple{"rt/joint_states", "sensor_msgs::msg::dds_::JointState_", &jointsOf}}) {
        TypeSupport(new Read(type, read)).register_type(participant);
        readers.push_back(
            subscriber->create_datareader(participant->create_topic(topic, type, TOPIC_QOS_DEFAULT), qos));
    }
    while (std::cout) {
        for (DataReader* reader : readers) {
            std::string line;
            SampleInfo info;
            while (reader->take_next_sample(&line, &info) == ReturnCode_t::RETCODE_OK) {
                if (info.valid_data) {
                    std::cout << line << '\n';
                }
            }
        }
        std::cout.flush();
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    std::_Exit(0);
}
