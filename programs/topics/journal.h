#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace programs::topics {

/// What was written and received, kept until the end. All calls from any thread.
class Journal {
 public:
  /// @param participant  its name.
  explicit Journal(std::string participant);

  /// @param was_accepted  whether the write succeeded. @param late_ns  how long after it was due
  /// the
  ///   sample was handed to DDS.
  void wrote(const std::string& topic, bool was_accepted, std::int64_t late_ns);
  /// @param writer  name of the writing participant. @param at_ns  CLOCK_REALTIME.
  void received(const std::string& topic, const std::string& writer, std::int64_t at_ns);

  /// A datagram of a flow of UDP.
  void sent(std::uint16_t port, bool was_accepted);
  void received_datagram(std::uint16_t port, const std::string& sender, std::int64_t at_ns);

  /// A topic that is written, though there may never be a sample.
  void add_written(const std::string& topic);

  /// What counted, as JSON. Nothing counts afterwards.
  std::string close();

 private:
  struct Written {
    std::uint64_t samples = 0, refused = 0;
    std::int64_t latest_ns = 0;
  };
  struct Received {
    std::uint64_t samples = 0;
    std::int64_t first_ns = 0, last_ns = 0;
    void add(std::int64_t at_ns) {
      if (samples++ == 0) first_ns = at_ns;
      last_ns = at_ns;
    }
  };

  std::mutex mutex_;
  std::string participant_;
  bool is_closed_ = false;
  std::map<std::string, Written> written_;
  std::map<std::pair<std::string, std::string>, Received> received_;
  std::map<std::uint16_t, Written> sent_;
  std::map<std::pair<std::uint16_t, std::string>, Received> datagrams_;
};

/// One journal of several processes' journals, each as of Journal::close() or empty.
std::string joined(const std::vector<std::string>& journals);

}  // namespace programs::topics
