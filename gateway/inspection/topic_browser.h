#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hal/types/message.h"
#include "hal/types/time.h"

namespace gateway::inspection {

/// A writer or reader in a domain, as it announces itself.
struct SeenEndpoint {
  bool is_writer = false;
  std::string participant;  ///< Twelve bytes in hexadecimal: equal for those of one process.
  bool is_reliable = false;
  std::string durability;  ///< "volatile", "transient_local", "transient", "persistent"
};

struct SeenTopic {
  std::string name;  ///< As in DDS: "rt/clock".
  std::string type;  ///< As in DDS: "rosgraph_msgs::msg::dds_::Clock_".
  bool has_key = false;
  std::vector<SeenEndpoint> endpoints;
  int count(bool writers) const;
};

/// One sample as it travelled: the four bytes of its encapsulation, then the value (OMG DDSI-RTPS
/// 2.3, 10.2).
struct RawSample {
  hal::Bytes bytes;
  std::int64_t source_time_ns = 0;  ///< Since 1970, on the sender's clock.
};

/// Samples of one topic, whatever its type.
class TopicSubscription {
 public:
  virtual ~TopicSubscription() = default;
  /// The next sample; waits for it up to `timeout`. One thread.
  virtual std::optional<RawSample> next(hal::Duration timeout) = 0;
  virtual int writers() const = 0;            ///< In sight now.
  virtual std::uint64_t dropped() const = 0;  ///< Samples that came faster than next() took them.
};

/// Looks at the topics of a DDS domain by ordinary discovery on 127.0.0.1.
class TopicBrowser {
 public:
  /// @throws std::runtime_error  if DDS cannot be opened.
  explicit TopicBrowser(int domain);
  ~TopicBrowser();
  TopicBrowser(const TopicBrowser&) = delete;
  TopicBrowser& operator=(const TopicBrowser&) = delete;

  /// What has been seen so far, by name. Any thread.
  std::vector<SeenTopic> topics() const;

  /// Reads a topic as its writers offer it: reliably, and with the samples that they keep, if all
  /// of them do so. Must not outlive this object.
  /// @throws std::runtime_error  if DDS makes no reader.
  std::unique_ptr<TopicSubscription> subscribe(const SeenTopic& topic);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// A sample of one of the types in idl/inspect.idl as a YAML document: members by name, lists as
/// lists. None: the type is another one, or the bytes are no value of it.
std::optional<std::string> to_yaml(const std::string& type, const hal::Bytes& sample);

}  // namespace gateway::inspection
