#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hal/types/message.h"
#include "hal/types/time.h"

namespace gateway::inspection {

/// A writer or reader in a domain, as announced by discovery.
struct SeenEndpoint {
  bool is_writer = false;
  std::string participant;  ///< GUID prefix of its participant: twelve bytes in hexadecimal.
  bool is_reliable = false;
  std::string durability;  ///< "volatile", "transient_local", "transient", "persistent"
};

struct SeenTopic {
  std::string name;  ///< Name in DDS: "rt/clock".
  std::string type;  ///< Name of the type in DDS: "rosgraph_msgs::msg::dds_::Clock_".
  bool has_key = false;
  std::vector<SeenEndpoint> endpoints;
  int count(bool writers) const;
};

/// One serialised sample: the four bytes of the encapsulation header, then the value (OMG DDSI-RTPS
/// 2.3, 10.2).
struct RawSample {
  hal::Bytes bytes;
  std::int64_t source_time_ns = 0;  ///< Since 1970, by the sender's clock.
};

/// Samples of one topic of any type.
class TopicSubscription {
 public:
  virtual ~TopicSubscription() = default;
  /// The next sample, or none if there is none within `timeout`. One thread.
  virtual std::optional<RawSample> next(hal::Duration timeout) = 0;
  virtual int writers() const = 0;  ///< Writers matched now.
  virtual std::uint64_t dropped()
      const = 0;  ///< Samples lost because next() was called too rarely.
};

/// Finds the topics of a DDS domain by ordinary discovery on 127.0.0.1.
class TopicBrowser {
 public:
  /// @throws std::runtime_error  if DDS cannot be opened.
  explicit TopicBrowser(int domain);
  ~TopicBrowser();
  TopicBrowser(const TopicBrowser&) = delete;
  TopicBrowser& operator=(const TopicBrowser&) = delete;

  /// The topics discovered so far, sorted by name. Any thread.
  std::vector<SeenTopic> topics() const;

  /// Reads a topic: reliably if all of its writers are reliable, and with kept samples if all of
  /// its writers keep them. The result must not outlive this object.
  /// @throws std::runtime_error  if DDS makes no reader.
  std::unique_ptr<TopicSubscription> subscribe(const SeenTopic& topic);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// A sample of one of the types in idl/inspect.idl as a YAML document: members by name, lists as
/// lists. None: the type is not one of these, or the bytes are not a value of it.
std::optional<std::string> to_yaml(const std::string& type, const hal::Bytes& sample);

}  // namespace gateway::inspection
