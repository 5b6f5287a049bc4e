"""Values of the HAL as named tuples. SI units, radians, x forward, y left, z up."""
import enum
import typing


class Vec2(typing.NamedTuple):
    """A vector in a plane."""
    x: float
    y: float


class Vec3(typing.NamedTuple):
    """A vector in space; z points up."""
    x: float
    y: float
    z: float


class Pose2(typing.NamedTuple):
    """Position [m] and heading [rad, (-pi, pi]] in a plane."""
    x: float
    y: float
    theta: float


class Twist2(typing.NamedTuple):
    """Velocity of a body in its own frame: m/s, m/s, rad/s."""
    vx: float
    vy: float
    omega: float


class Drive(typing.NamedTuple):
    """Effect of a drive command."""
    applied: Twist2   # velocity that the motors are to reach
    saturated: bool   # a motor's limit was exceeded, and the command scaled down
    restricted: bool  # a part of it is not feasible for these wheels and was left out


class InfraredReading(typing.NamedTuple):
    """One infrared ranging sensor."""
    heading: float  # rad in the body frame
    range: float    # m; NaN: nothing within range


class Odometry(typing.NamedTuple):
    """Dead reckoning from the wheels since the start of the run."""
    pose: Pose2
    twist: Twist2


class Scan(typing.NamedTuple):
    """A scan of a laser scanner, two arrays of equal length."""
    headings: typing.Any  # rad in the scanner's frame, ascending
    ranges: typing.Any    # m; NaN: nothing within range; -infinity: too near to be measured


class Imu(typing.NamedTuple):
    """A reading of an inertial measurement unit, in its own frame."""
    angular_velocity: Vec3  # rad/s
    specific_force: Vec3    # m/s^2


class Message(typing.NamedTuple):
    """A message from one agent to another."""
    source: int
    destination: int  # an address, EVERYONE or NEIGHBOURS
    id: int           # unique among the messages of `source`
    topic: str
    payload: bytes
    priority: int


class Route(typing.NamedTuple):
    """An entry of a routing table."""
    topic: str
    destination: int
    next_hop: int
    hops: int
    delay: float       # s
    min_snr_db: float  # dB
    energy: float      # J


class Neighbour(typing.NamedTuple):
    """A node whose frames this agent receives directly."""
    id: int
    last_heard: float  # s
    rssi_dbm: float


class Channel(typing.NamedTuple):
    """A stream of readings that an agent offers: hal/types/channel.h."""
    id: int
    name: str
    kind: str
    unit: str
    length: int
    period: float
    frame: str
    headings: typing.Any
    low: float
    high: float
    position: Vec3
    heading: float


class Solid(typing.NamedTuple):
    """An upright shape of a body, in the body's frame."""
    shape: str  # arrow, box, sphere or cylinder
    size: Vec3
    centre: Vec3
    yaw: float


class BodyWheel(typing.NamedTuple):
    """A wheel of a robot: hal/types/robot_body.h."""
    is_driven: bool
    position: Vec2
    axle_heading: float
    roller_angle: float
    radius: float
    max_speed: float
    max_torque: float


class RobotBody(typing.NamedTuple):
    """Shape and wheels of a robot."""
    model: str
    solids: list
    wheels: list


class Fate(enum.Enum):
    """The result of a send()."""
    HANDED_OVER = "handed over"
    NO_ROUTE = "no route"
    QUEUE_FULL = "queue full"
    FAILED = "failed"


class Priority(enum.IntEnum):
    """Priority of a message on the air: user priorities of IEEE Std 802.1D."""
    BEST_EFFORT = 0
    BACKGROUND = 1
    VIDEO = 5
    VOICE = 6
