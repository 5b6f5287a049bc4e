#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "gateway/domain/participant.h"
#include "gateway/guard/guarded_type.h"

namespace gateway::inspection {

/// Whether a topic's last samples are kept for readers that join later.
enum class Keep : std::uint8_t { kForLatecomers, kForThoseHere };

/// QoS of inspection topics. Reliable, so that every standard reader matches; keep last, so that no
/// reader makes the writer wait. Measured in a run at 900 times real time with 40,000 samples per
/// second: 14 us per sample, also if the reader never takes them or its process is stopped. That is
/// why samples are written on the thread of the run.
/// @param depth  samples kept for a slow reader, > 0.
guard::api::DataWriterQos inspection_writer_qos(int depth, Keep keep);
/// @param reliability  reliable readers do not match best-effort writers.
guard::api::DataReaderQos inspection_reader_qos(guard::api::ReliabilityQosPolicyKind reliability,
                                                Keep keep);

/// The writer of an inspection topic, the topic, a sample to fill in and the number of readers.
/// @tparam PubSub  generated for the type of the samples.
template <class PubSub>
class InspectionWriter {
 public:
  /// @param depth  samples kept for a slow reader.
  /// @param all_readers  counts readers; may be shared with other writers.
  /// @throws std::runtime_error  if DDS makes no writer.
  InspectionWriter(domain::Participant& participant, const std::string& topic, int depth,
                   std::atomic<int>& all_readers, Keep keep = Keep::kForThoseHere)
      : participant_(participant),
        readers_(all_readers),
        topic_(participant.add_topic(topic,
                                     guard::api::TypeSupport(new guard::GuardedType<PubSub>()))),
        writer_(participant.publisher().create_datawriter(
            topic_, inspection_writer_qos(depth, keep), &readers_,
            guard::api::StatusMask::publication_matched())) {
    if (writer_ == nullptr) throw std::runtime_error("Fast DDS makes no writer of " + topic);
  }
  ~InspectionWriter() {
    participant_.remove_writer(writer_);
    participant_.remove_topic(topic_);
  }
  InspectionWriter(const InspectionWriter&) = delete;
  InspectionWriter& operator=(const InspectionWriter&) = delete;

  bool has_readers() const noexcept { return readers_.count.load(std::memory_order_relaxed) > 0; }
  typename PubSub::type& sample() { return sample_; }
  /// Writes sample(). If DDS refuses it, the sample is lost: inspection must not end a run.
  void write() { writer_->write(&sample_); }

 private:
  struct Readers : guard::api::DataWriterListener {
    explicit Readers(std::atomic<int>& of_all) : all(of_all) {}
    void on_publication_matched(guard::api::DataWriter* writer,
                                const guard::api::PublicationMatchedStatus& status) override {
      (void)writer;
      count.store(status.current_count, std::memory_order_relaxed);
      all.fetch_add(status.current_count_change, std::memory_order_relaxed);
    }
    std::atomic<int> count{0};
    std::atomic<int>& all;
  };

  domain::Participant& participant_;
  Readers readers_;
  typename PubSub::type sample_;
  guard::api::Topic* topic_;
  guard::api::DataWriter* writer_;
};

/// The reader of a topic that others write. Passes each sample to a function.
template <class PubSub>
class InspectionReader {
 public:
  using Sample = typename PubSub::type;

  /// Handles identify the writers of samples. Both functions are called on a thread of DDS.
  using OnSample = std::function<void(const Sample&, const guard::api::SampleInfo&)>;
  using OnLeft = std::function<void(const guard::api::InstanceHandle_t& writer)>;

  /// @param topic  owned by the caller.
  /// @param on_left  called when a writer is gone; may be empty.
  /// @throws std::runtime_error  if DDS makes no reader.
  InspectionReader(domain::Participant& participant, guard::api::Topic* topic,
                   const guard::api::DataReaderQos& qos, OnSample on_sample, OnLeft on_left = {})
      : participant_(participant),
        inbox_(std::move(on_sample), std::move(on_left)),
        reader_(participant.subscriber().create_datareader(topic, qos, &inbox_)) {
    if (reader_ == nullptr) {
      throw std::runtime_error("Fast DDS makes no reader of " + topic->get_name());
    }
  }
  ~InspectionReader() { participant_.subscriber().delete_datareader(reader_); }
  InspectionReader(const InspectionReader&) = delete;
  InspectionReader& operator=(const InspectionReader&) = delete;

  int writers() const { return inbox_.writers.load(std::memory_order_relaxed); }

 private:
  struct Inbox : guard::api::DataReaderListener {
    Inbox(OnSample sample, OnLeft left) : on_sample(std::move(sample)), on_left(std::move(left)) {}
    void on_data_available(guard::api::DataReader* reader) override {
      Sample sample;
      guard::api::SampleInfo info;
      while (guard::is_ok(reader->take_next_sample(&sample, &info))) {
        if (info.valid_data) on_sample(sample, info);
      }
    }
    void on_subscription_matched(guard::api::DataReader* reader,
                                 const guard::api::SubscriptionMatchedStatus& status) override {
      (void)reader;
      writers.store(status.current_count, std::memory_order_relaxed);
      const bool one_left = status.current_count_change < 0;
      if (one_left && on_left)
        on_left(guard::api::InstanceHandle_t(status.last_publication_handle));
    }
    OnSample on_sample;
    OnLeft on_left;
    std::atomic<int> writers{0};
  };

  domain::Participant& participant_;
  Inbox inbox_;
  guard::api::DataReader* reader_;
};

/// A topic that exists as long as this object.
template <class PubSub>
class OwnTopic {
 public:
  OwnTopic(domain::Participant& participant, const std::string& name)
      : participant_(participant),
        topic_(participant.add_topic(name,
                                     guard::api::TypeSupport(new guard::GuardedType<PubSub>()))) {}
  ~OwnTopic() { participant_.remove_topic(topic_); }
  OwnTopic(const OwnTopic&) = delete;
  OwnTopic& operator=(const OwnTopic&) = delete;
  guard::api::Topic* get() { return topic_; }

 private:
  domain::Participant& participant_;
  guard::api::Topic* topic_;
};

/// The latest valid sample of a topic that others write, converted to a value. Any thread.
template <class PubSub, class Value>
class LatestSample {
 public:
  /// Converts a sample; `before` is the previous value. None: the sample is invalid and is dropped.
  using Read = std::optional<Value> (*)(const typename PubSub::type& sample,
                                        const std::optional<Value>& before);
  using OnValue = std::function<void(const Value&)>;

  /// @param topic  name in DDS: "rt/r0/cmd_vel".
  /// @param on_value  called on a thread of DDS with each valid value; may be empty.
  /// @throws std::runtime_error  if DDS makes no reader.
  LatestSample(domain::Participant& participant, const std::string& topic, Read read,
               OnValue on_value)
      : read_(read),
        on_value_(std::move(on_value)),
        topic_(participant, topic),
        reader_(participant, topic_.get(),
                inspection_reader_qos(guard::api::BEST_EFFORT_RELIABILITY_QOS, Keep::kForThoseHere),
                [this](const auto& sample, const guard::api::SampleInfo&) { on_sample(sample); }) {}

  std::optional<Value> last() const {
    const std::lock_guard lock(mutex_);
    return last_;
  }
  std::uint64_t dropped() const { return dropped_; }
  int writers() const { return reader_.writers(); }

 private:
  void on_sample(const typename PubSub::type& sample) {
    std::optional<Value> value;
    {
      const std::lock_guard lock(mutex_);
      value = read_(sample, last_);
      if (value) last_ = value;
    }
    if (!value) ++dropped_;
    if (value && on_value_) on_value_(*value);
  }

  Read read_;
  OnValue on_value_;
  mutable std::mutex mutex_;
  std::optional<Value> last_;
  std::atomic<std::uint64_t> dropped_{0};
  OwnTopic<PubSub> topic_;
  InspectionReader<PubSub> reader_;
};

}  // namespace gateway::inspection
