#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "exchangePubSubTypes.h"
#include "hal/dds/convert.h"
#include "hal/dds/participant.h"
#include "hal/dds/waiting.h"

namespace hal::dds {

template <class Wire>
struct PubSubTypeOf;
template <>
struct PubSubTypeOf<wire::Hello> {
  using Type = wire::HelloPubSubType;
};
template <>
struct PubSubTypeOf<wire::Session> {
  using Type = wire::SessionPubSubType;
};
template <>
struct PubSubTypeOf<wire::Step> {
  using Type = wire::StepPubSubType;
};
template <>
struct PubSubTypeOf<wire::Reply> {
  using Type = wire::ReplyPubSubType;
};

/// The writer of a topic, and the topic.
template <class Wire>
class Writer {
 public:
  /// @throws std::runtime_error
  Writer(Participant& participant, const std::string& topic)
      : participant_(participant),
        topic_(participant.add_topic(topic,
                                     api::TypeSupport(new typename PubSubTypeOf<Wire>::Type()))),
        writer_(participant.publisher().create_datawriter(topic_, writer_qos())) {
    if (writer_ == nullptr) throw std::runtime_error("Fast DDS makes no writer of " + topic);
  }
  ~Writer() {
    participant_.publisher().delete_datawriter(writer_);
    participant_.remove_topic(topic_);
  }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  [[nodiscard]] bool write(Wire& sample) { return writer_->write(&sample); }

  /// Waits until every reader has the last sample.
  void flush(Duration timeout) { writer_->wait_for_acknowledgments(to_dds(timeout)); }

 private:
  Participant& participant_;
  api::Topic* topic_;
  api::DataWriter* writer_;
};

/// Whom a sample came from.
using Origin = rtps::InstanceHandle_t;

/// Tells a waiting thread that a reader has something new: a sample, or a writer less.
class ReaderListener : public api::DataReaderListener {
 public:
  explicit ReaderListener(Signal& signal) : signal_(signal) {}

  void on_data_available(api::DataReader* reader) override {
    (void)reader;
    has_samples_ = true;
    signal_.raise();
  }
  void on_subscription_matched(api::DataReader* reader,
                               const api::SubscriptionMatchedStatus& status) override {
    (void)reader;
    writers_ = status.current_count;
    if (status.current_count_change < 0) note(left_, status.last_publication_handle);
  }
  void on_liveliness_changed(api::DataReader* reader,
                             const api::LivelinessChangedStatus& status) override {
    (void)reader;
    if (status.not_alive_count_change > 0) note(silent_, status.last_publication_handle);
  }

  std::atomic<bool> has_samples_{false};
  std::atomic<int> writers_{0};

  /// Writers that left the domain, and writers that were not heard for kLivelinessLease, since the
  /// last call.
  std::vector<Origin> take_left() { return take(left_); }
  std::vector<Origin> take_silent() { return take(silent_); }

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

  Signal& signal_;
  std::mutex mutex_;
  std::vector<Origin> left_, silent_;
};

/// The reader of a topic, and the topic. Raises a signal when there is something to do.
template <class Wire>
class Reader {
 public:
  /// @throws std::runtime_error
  Reader(Participant& participant, const std::string& topic, Signal& signal)
      : participant_(participant),
        topic_(participant.add_topic(topic,
                                     api::TypeSupport(new typename PubSubTypeOf<Wire>::Type()))),
        listener_(signal),
        reader_(participant.subscriber().create_datareader(topic_, reader_qos(), &listener_)) {
    if (reader_ == nullptr) throw std::runtime_error("Fast DDS makes no reader of " + topic);
  }
  ~Reader() {
    participant_.subscriber().delete_datareader(reader_);
    participant_.remove_topic(topic_);
  }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  /// The next sample, good until the next call; null if there is none.
  const Wire* take() {
    if (!listener_.has_samples_) return nullptr;
    listener_.has_samples_ = false;
    api::SampleInfo info;
    while (is_ok(reader_->take_next_sample(&sample_, &info))) {
      if (!info.valid_data) continue;
      listener_.has_samples_ = true;  // There may be more.
      origin_ = Origin(info.publication_handle);
      return &sample_;
    }
    return nullptr;
  }
  const Origin& origin() const { return origin_; }  ///< Of the sample that take() gave.

  ReaderListener& listener() { return listener_; }
  const ReaderListener& listener() const { return listener_; }

 private:
  Participant& participant_;
  api::Topic* topic_;
  ReaderListener listener_;
  api::DataReader* reader_;
  Wire sample_;
  Origin origin_;
};

}  // namespace hal::dds
