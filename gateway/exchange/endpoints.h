#pragma once

#include <atomic>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "exchangePubSubTypes.h"
#include "gateway/domain/participant.h"
#include "gateway/exchange/convert.h"
#include "gateway/exchange/origin.h"
#include "gateway/exchange/quota.h"
#include "gateway/guard/guarded_type.h"
#include "gateway/process/waiting.h"

namespace gateway::exchange {

/// @tparam Wire  generated for a topic. kMostInstances: maximum number of instances that one
/// participant may have at one reader.
template <class Wire>
struct PubSubTypeOf;
template <>
struct PubSubTypeOf<wire::Hello> {
  using Type = wire::HelloPubSubType;
  static constexpr domain::Presence kPresence = domain::Presence::kWatched;
  static constexpr std::size_t kMostInstances = 8;  // a controller sends one
};
template <>
struct PubSubTypeOf<wire::Session> {
  using Type = wire::SessionPubSubType;
  static constexpr domain::Presence kPresence = domain::Presence::kWatched;
  static constexpr std::size_t kMostInstances = domain::kMaxInstances;  // one per controller
};
template <>
struct PubSubTypeOf<wire::Step> {
  using Type = wire::StepPubSubType;
  static constexpr domain::Presence kPresence = domain::Presence::kIgnored;
  static constexpr std::size_t kMostInstances = 64;  // a server writes one
};
template <>
struct PubSubTypeOf<wire::Reply> {
  using Type = wire::ReplyPubSubType;
  static constexpr domain::Presence kPresence = domain::Presence::kIgnored;
  static constexpr std::size_t kMostInstances = 64;  // one per server
};

/// The writer of a topic, and the topic.
template <class Wire>
class Writer {
 public:
  /// @throws std::runtime_error  Fast DDS refuses the topic or the writer.
  Writer(domain::Participant& participant, const std::string& topic)
      : participant_(participant),
        topic_(participant.add_topic(
            topic,
            guard::api::TypeSupport(new guard::GuardedType<typename PubSubTypeOf<Wire>::Type>()))),
        writer_(participant.publisher().create_datawriter(
            topic_, domain::writer_qos(PubSubTypeOf<Wire>::kPresence))) {
    if (writer_ == nullptr) throw std::runtime_error("Fast DDS makes no writer of " + topic);
  }
  ~Writer() {
    participant_.remove_writer(writer_);
    participant_.remove_topic(topic_);
  }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  [[nodiscard]] bool write(Wire& sample) { return writer_->write(&sample); }
  /// Ends the life of the sample's instance: later readers do not receive it, and when all present
  /// readers know about it, it needs no memory.
  [[nodiscard]] bool dispose(Wire& sample) {
    return guard::is_ok(writer_->unregister_instance(&sample, guard::rtps::InstanceHandle_t()));
  }

  /// Readers that have been discovered.
  int readers() const {
    guard::api::PublicationMatchedStatus status;
    writer_->get_publication_matched_status(status);
    return status.current_count;
  }

  /// Waits until every reader has received the last sample.
  void flush(hal::Duration timeout) { writer_->wait_for_acknowledgments(guard::to_dds(timeout)); }

 private:
  domain::Participant& participant_;
  guard::api::Topic* topic_;
  guard::api::DataWriter* writer_;
};

/// Records that writers come and go, and wakes up a waiting thread.
class PresenceListener : public guard::api::DataReaderListener {
 public:
  explicit PresenceListener(process::Signal& signal) : signal_(signal) {}

  void on_subscription_matched(guard::api::DataReader* reader,
                               const guard::api::SubscriptionMatchedStatus& status) override {
    (void)reader;
    writers_ = status.current_count;
    if (status.current_count_change < 0) note(left_, status.last_publication_handle);
  }
  void on_liveliness_changed(guard::api::DataReader* reader,
                             const guard::api::LivelinessChangedStatus& status) override {
    (void)reader;
    if (status.not_alive_count_change > 0) note(silent_, status.last_publication_handle);
  }

  int writers() const { return writers_; }  ///< Writers that are matched now.
  /// Writers that have left the domain, and writers that were silent for kLivelinessLease, since
  /// the last call.
  std::vector<Origin> take_left() { return take(left_); }
  std::vector<Origin> take_silent() { return take(silent_); }

 protected:
  process::Signal& signal_;
  std::mutex mutex_;

 private:
  void note(std::vector<Origin>& list, const Origin& origin) {
    {
      const std::lock_guard lock(mutex_);
      list.push_back(origin);
    }
    signal_.raise();
  }
  std::vector<Origin> take(std::vector<Origin>& list) {
    const std::lock_guard lock(mutex_);
    return std::exchange(list, {});
  }

  std::atomic<int> writers_{0};
  std::vector<Origin> left_, silent_;
};

/// Calls `use(value, info)` for every sample that a reader has; `use` may move from the value.
/// @param value  memory for one sample at a time.
template <class Wire, class Use>
void take_all(guard::api::DataReader& reader, Quota& quota, Wire& value, const Use& use) {
  guard::api::SampleInfo info;
  while (guard::is_ok(reader.take_next_sample(&value, &info))) {
    if (quota.admits(info)) use(value, info);
  }
}

/// Takes samples out of DDS on the thread that receives them. A waiting thread that took them
/// itself would, just woken, run into the lock that the receiving thread still holds: measured 13
/// instead of 9 context switches per exchange.
template <class Wire>
class Inbox : public PresenceListener {
 public:
  struct Sample {
    Wire value;
    Origin origin;
  };
  Inbox(process::Signal& signal, guard::DatagramFilter& filter)
      : PresenceListener(signal), quota_(filter, PubSubTypeOf<Wire>::kMostInstances) {}

  void on_subscription_matched(guard::api::DataReader* reader,
                               const guard::api::SubscriptionMatchedStatus& status) override {
    if (status.current_count_change < 0) quota_.leave(status.last_publication_handle);
    PresenceListener::on_subscription_matched(reader, status);
  }
  void on_data_available(guard::api::DataReader* reader) override {
    Wire value;
    take_all(*reader, quota_, value, [this](Wire& sample, const guard::api::SampleInfo& info) {
      const std::lock_guard lock(mutex_);
      // As in DDS itself, the oldest samples are dropped if a reader cannot keep up.
      if (samples_.size() == kMostWaiting) samples_.pop_front();
      samples_.push_back({std::move(sample), Origin(info.publication_handle)});
    });
    if (!is_empty()) signal_.raise();  // else only an instance was disposed of
  }

  std::optional<Sample> take() {
    const std::lock_guard lock(mutex_);
    if (samples_.empty()) return std::nullopt;
    std::optional<Sample> sample(std::move(samples_.front()));
    samples_.pop_front();
    return sample;
  }
  bool is_empty() {
    const std::lock_guard lock(mutex_);
    return samples_.empty();
  }

 private:
  static constexpr std::size_t kMostWaiting = domain::kMaxInstances;

  Quota quota_;
  std::deque<Sample> samples_;
};

/// The reader of a topic, and the topic. Its listener outlives it.
template <class Wire>
class BareReader {
 public:
  /// @throws std::runtime_error  Fast DDS refuses the topic or the reader.
  BareReader(domain::Participant& participant, const std::string& topic,
             guard::api::DataReaderListener& listener)
      : participant_(participant),
        topic_(participant.add_topic(
            topic,
            guard::api::TypeSupport(new guard::GuardedType<typename PubSubTypeOf<Wire>::Type>()))),
        reader_(participant.subscriber().create_datareader(
            topic_, domain::reader_qos(PubSubTypeOf<Wire>::kPresence), &listener)) {
    if (reader_ == nullptr) throw std::runtime_error("Fast DDS makes no reader of " + topic);
  }
  ~BareReader() {
    participant_.subscriber().delete_datareader(reader_);
    participant_.remove_topic(topic_);
  }
  BareReader(const BareReader&) = delete;
  BareReader& operator=(const BareReader&) = delete;

 private:
  domain::Participant& participant_;
  guard::api::Topic* topic_;
  guard::api::DataReader* reader_;
};

/// A reader that raises a signal when there is something to do.
template <class Wire>
class Reader {
 public:
  /// @throws std::runtime_error  Fast DDS refuses the topic or the reader.
  Reader(domain::Participant& participant, const std::string& topic, process::Signal& signal)
      : inbox_(signal, participant.filter()), reader_(participant, topic, inbox_) {}

  /// The next sample, valid until the next call; null if there is none.
  const Wire* take() {
    current_ = inbox_.take();
    return current_ ? &current_->value : nullptr;
  }
  const Origin& origin() const { return current_->origin; }  ///< @pre take() has returned a sample.
  bool is_empty() { return inbox_.is_empty(); }

  PresenceListener& presence() { return inbox_; }
  const PresenceListener& presence() const { return inbox_; }

 private:
  Inbox<Wire> inbox_;
  BareReader<Wire> reader_;
  std::optional<typename Inbox<Wire>::Sample> current_;
};

/// A reader that passes samples to a function on the thread that receives them. The function must
/// not wait for a thread that holds a lock of DDS.
template <class Wire>
class HandlingReader {
 public:
  using Handle = std::function<void(const Wire&, const Origin&)>;
  /// @throws std::runtime_error  Fast DDS refuses the topic or the reader.
  HandlingReader(domain::Participant& participant, const std::string& topic, Handle handle)
      : listener_(std::move(handle), participant.filter()),
        reader_(participant, topic, listener_) {}

 private:
  class Listener : public guard::api::DataReaderListener {
   public:
    Listener(Handle handle, guard::DatagramFilter& filter)
        : handle_(std::move(handle)), quota_(filter, PubSubTypeOf<Wire>::kMostInstances) {}
    void on_data_available(guard::api::DataReader* reader) override {
      take_all(*reader, quota_, value_,
               [this](const Wire& value, const guard::api::SampleInfo& info) {
                 handle_(value, Origin(info.publication_handle));
               });
    }
    void on_subscription_matched(guard::api::DataReader* reader,
                                 const guard::api::SubscriptionMatchedStatus& status) override {
      (void)reader;
      if (status.current_count_change < 0) quota_.leave(status.last_publication_handle);
    }

   private:
    Handle handle_;
    Quota quota_;
    Wire value_;  ///< The last sample; its memory is reused.
  };
  Listener listener_;
  BareReader<Wire> reader_;
};

}  // namespace gateway::exchange
