#include "gateway/inspection/topic_browser.h"

#include <fmt/format.h>

#include <algorithm>
#include <condition_variable>
#include <cstring>
#include <deque>
#include <map>
#include <mutex>

#include "gateway/inspection/inspection_endpoints.h"

namespace gateway::inspection {
namespace {

/// Most samples that wait for next().
constexpr std::size_t kMostWaiting = 10'000;

/// A type of which only the name is known: its values are byte strings.
class RawType : public guard::api::TopicDataType {
 public:
  RawType(const std::string& name, bool has_key) {
    setName(name.c_str());
    m_typeSize = 1024;  // initial size; grows with the samples
    m_isGetKeyDefined = has_key;
  }
  bool serialize(void* value, guard::rtps::SerializedPayload_t* payload) override {
    (void)value, (void)payload;
    return false;  // samples are only read
  }
  bool deserialize(guard::rtps::SerializedPayload_t* payload, void* value) override {
    static_cast<hal::Bytes*>(value)->assign(payload->data, payload->data + payload->length);
    return true;
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* value) override {
    return [value] { return static_cast<std::uint32_t>(static_cast<hal::Bytes*>(value)->size()); };
  }
  void* createData() override { return new hal::Bytes; }
  void deleteData(void* value) override { delete static_cast<hal::Bytes*>(value); }
  /// All samples count as one instance. Fast DDS aborts if a keyed topic gives no key.
  bool getKey(void* value, guard::rtps::InstanceHandle_t* handle, bool force_md5) override {
    (void)value, (void)force_md5;
    handle->value[0] = 1;
    return true;
  }
};

class Subscription final : public TopicSubscription, public guard::api::DataReaderListener {
 public:
  Subscription(domain::Participant& participant, const SeenTopic& seen)
      : participant_(participant),
        topic_(participant.add_topic(
            seen.name, guard::api::TypeSupport(new RawType(seen.type, seen.has_key)))) {
    reader_ = participant.subscriber().create_datareader(topic_, qos(seen), this);
    if (reader_ == nullptr) {
      participant.remove_topic(topic_);
      throw std::runtime_error("Fast DDS makes no reader of " + seen.name);
    }
  }
  ~Subscription() override {
    participant_.subscriber().delete_datareader(reader_);
    participant_.remove_topic(topic_);
  }
  Subscription(const Subscription&) = delete;
  Subscription& operator=(const Subscription&) = delete;

  std::optional<RawSample> next(hal::Duration timeout) override {
    std::unique_lock lock(mutex_);
    if (!arrived_.wait_for(lock, timeout, [this] { return !samples_.empty(); })) {
      return std::nullopt;
    }
    RawSample sample = std::move(samples_.front());
    samples_.pop_front();
    return sample;
  }
  int writers() const override { return writers_; }
  std::uint64_t dropped() const override { return dropped_; }

  void on_data_available(guard::api::DataReader* reader) override {
    while (true) {
      RawSample sample;
      guard::api::SampleInfo info;
      if (!guard::is_ok(reader->take_next_sample(&sample.bytes, &info))) return;
      if (!info.valid_data) continue;
      sample.source_time_ns = info.source_timestamp.to_ns();
      const std::lock_guard lock(mutex_);
      if (samples_.size() == kMostWaiting) {
        samples_.pop_front();
        ++dropped_;
      }
      samples_.push_back(std::move(sample));
      arrived_.notify_one();
    }
  }
  void on_subscription_matched(guard::api::DataReader* reader,
                               const guard::api::SubscriptionMatchedStatus& status) override {
    (void)reader;
    writers_ = status.current_count;
  }

 private:
  static guard::api::DataReaderQos qos(const SeenTopic& seen) {
    const auto all_writers = [&](const auto& holds) {
      return std::ranges::all_of(seen.endpoints,
                                 [&](const auto& one) { return !one.is_writer || holds(one); });
    };
    const bool kept = all_writers([](const auto& w) { return w.durability != "volatile"; });
    const bool reliable = all_writers([](const auto& w) { return w.is_reliable; });
    return inspection_reader_qos(
        reliable ? guard::api::RELIABLE_RELIABILITY_QOS : guard::api::BEST_EFFORT_RELIABILITY_QOS,
        kept ? Keep::kForLatecomers : Keep::kForThoseHere);
  }

  domain::Participant& participant_;
  guard::api::Topic* topic_;
  guard::api::DataReader* reader_;
  std::mutex mutex_;
  std::condition_variable arrived_;
  std::deque<RawSample> samples_;
  std::atomic<int> writers_{0};
  std::atomic<std::uint64_t> dropped_{0};
};

std::string durability_name(guard::api::DurabilityQosPolicyKind kind) {
  constexpr const char* kNames[] = {"volatile", "transient_local", "transient", "persistent"};
  return kind < std::size(kNames) ? kNames[kind] : "unknown";
}

std::string hexadecimal(const guard::rtps::GuidPrefix_t& prefix) {
  std::string text;
  for (const guard::rtps::octet byte : prefix.value) text += fmt::format("{:02x}", byte);
  return text;
}

}  // namespace

int SeenTopic::count(bool writers) const {
  return static_cast<int>(
      std::ranges::count_if(endpoints, [&](const auto& e) { return e.is_writer == writers; }));
}

class TopicBrowser::Implementation : public guard::api::DomainParticipantListener {
 public:
  explicit Implementation(int domain)
      : participant_(domain::Participant::inspection(domain, {"127.0.0.1"}, "baraka topic", this)) {
  }

  std::vector<SeenTopic> topics() const;
  domain::Participant& participant() { return participant_; }

  void on_publisher_discovery(guard::api::DomainParticipant* participant,
                              guard::rtps::WriterDiscoveryInfo&& seen) override {
    (void)participant;
    note(seen.info, seen.status == guard::rtps::WriterDiscoveryInfo::REMOVED_WRITER, true);
  }
  void on_subscriber_discovery(guard::api::DomainParticipant* participant,
                               guard::rtps::ReaderDiscoveryInfo&& seen) override {
    (void)participant;
    note(seen.info, seen.status == guard::rtps::ReaderDiscoveryInfo::REMOVED_READER, false);
  }

 private:
  struct Seen {
    std::string topic, type;
    bool has_key = false;
    SeenEndpoint endpoint;
  };

  template <class Proxy>
  void note(const Proxy& proxy, bool removed, bool is_writer) {
    const std::lock_guard lock(mutex_);
    if (removed) {
      endpoints_.erase(proxy.guid());
      return;
    }
    endpoints_[proxy.guid()] = {
        proxy.topicName().to_string(),
        proxy.typeName().to_string(),
        proxy.topicKind() == guard::rtps::WITH_KEY,
        {.is_writer = is_writer,
         .participant = hexadecimal(proxy.guid().guidPrefix),
         .is_reliable = proxy.m_qos.m_reliability.kind == guard::api::RELIABLE_RELIABILITY_QOS,
         .durability = durability_name(proxy.m_qos.m_durability.kind)}};
  }

  mutable std::mutex mutex_;
  std::map<guard::rtps::GUID_t, Seen> endpoints_;
  /// The last member, because it calls back as soon as it is constructed.
  domain::Participant participant_;
};

std::vector<SeenTopic> TopicBrowser::Implementation::topics() const {
  // Two types with the same topic name count as two topics.
  std::map<std::pair<std::string, std::string>, SeenTopic> found;
  const std::lock_guard lock(mutex_);
  for (const auto& [guid, seen] : endpoints_) {
    SeenTopic& topic = found[{seen.topic, seen.type}];
    topic.name = seen.topic;
    topic.type = seen.type;
    topic.has_key = seen.has_key;
    topic.endpoints.push_back(seen.endpoint);
  }
  std::vector<SeenTopic> topics;
  topics.reserve(found.size());
  for (auto& [name, topic] : found) topics.push_back(std::move(topic));
  return topics;
}

TopicBrowser::TopicBrowser(int domain)
    : implementation_(std::make_unique<Implementation>(domain)) {}
TopicBrowser::~TopicBrowser() = default;

std::vector<SeenTopic> TopicBrowser::topics() const { return implementation_->topics(); }

std::unique_ptr<TopicSubscription> TopicBrowser::subscribe(const SeenTopic& topic) {
  return std::make_unique<Subscription>(implementation_->participant(), topic);
}

}  // namespace gateway::inspection
