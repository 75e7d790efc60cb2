"""Requests as bytes, as no well-behaved client would send them, and connections to a node that do without rospy."""
import socket
import struct
import threading
import xmlrpc.client

import rosgraph

from contact_path.msg import Increment
from contact_path.srv import TracePath

CALLER = '/stress_wire'
FORMATS = {'bool': '<?', 'uint8': '<B', 'int32': '<i', 'uint32': '<I', 'float32': '<f', 'float64': '<d'}


class Repeated:
    """A list of `times` equal elements; `told`: the length that the message claims, if it is another one."""

    def __init__(self, element, times, told=None):
        self.element = element
        self.times = times
        self.told = times if told is None else told


class Encoded:
    """A list whose elements are there as bytes."""

    def __init__(self, elements):
        self.elements = list(elements)


def wire(value, kind=None):
    """A message as bytes. Strings may be bytes, lists may be Repeated or Encoded."""
    if isinstance(value, Repeated):
        return struct.pack('<I', value.told) + wire(value.element, kind[:-2]) * value.times
    if isinstance(value, Encoded):
        return struct.pack('<I', len(value.elements)) + b''.join(value.elements)
    if kind and kind.endswith('[]'):
        return struct.pack('<I', len(value)) + b''.join(wire(element, kind[:-2]) for element in value)
    if kind == 'string':
        data = value if isinstance(value, bytes) else value.encode()
        return struct.pack('<I', len(data)) + data
    if kind in FORMATS:
        return struct.pack(FORMATS[kind], value)
    return b''.join(wire(getattr(value, slot), of) for slot, of in zip(value.__slots__, value._slot_types))


def _header(**fields):
    data = b''
    for key, value in fields.items():
        field = ('%s=%s' % (key, value)).encode()
        data += struct.pack('<I', len(field)) + field
    return struct.pack('<I', len(data)) + data


def _receive(connection, size):
    data = b''
    while len(data) < size:
        part = connection.recv(size - len(data))
        if not part:
            raise ConnectionError('the node has closed the connection')
        data += part
    return data


def _receive_block(connection):
    return _receive(connection, struct.unpack('<I', _receive(connection, 4))[0])


class Refused(Exception):
    """roscpp itself refused the request."""


class Client:
    """A connection to a service of a node that lasts: the master is needed only to make it."""

    def __init__(self, node, service='trace', kind=TracePath, timeout=60.0):
        uri = rosgraph.Master(CALLER).lookupService(node + '/' + service)
        host, port = uri[len('rosrpc://'):].split(':')
        self._answer = kind._response_class
        self._connection = socket.create_connection((host, int(port)), timeout)
        self._connection.sendall(_header(callerid=CALLER, service=node + '/' + service, md5sum=kind._md5sum,
                                         persistent='1'))
        _receive_block(self._connection)

    def send(self, request):
        data = request if isinstance(request, bytes) else wire(request)
        self._connection.sendall(struct.pack('<I', len(data)) + data)

    def receive(self):
        accepted = _receive(self._connection, 1) == b'\x01'
        answer = _receive_block(self._connection)
        if not accepted:
            raise Refused(answer.decode('utf-8', 'replace'))
        return self._answer().deserialize(answer)

    def call(self, request):
        self.send(request)
        return self.receive()

    def close(self):
        self._connection.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()


class Subscriber:
    """A connection to the increments of a node. It keeps them as bytes; a deaf one never reads."""

    def __init__(self, node, deaf=False):
        api = xmlrpc.client.ServerProxy(rosgraph.Master(CALLER).lookupNode(node))
        topic = node + '/increments'
        _, _, (_, host, port) = api.requestTopic(CALLER, topic, [['TCPROS']])
        self._connection = socket.socket()
        if deaf:
            self._connection.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        self._connection.connect((host, port))
        self._connection.sendall(_header(callerid=CALLER, topic=topic, type=Increment._type,
                                         md5sum=Increment._md5sum, message_definition=''))
        _receive_block(self._connection)
        self.increments = []
        self._thread = threading.Thread(target=self._read, daemon=True)
        if not deaf:
            self._thread.start()

    def _read(self):
        with self._connection.makefile('rb', 2 ** 20) as stream:
            while True:
                size = stream.read(4)
                increment = stream.read(struct.unpack('<I', size)[0]) if len(size) == 4 else b''
                if not increment or len(increment) < struct.unpack('<I', size)[0]:
                    return  # the node is gone, in the middle of an increment or not
                self.increments.append(increment)

    def wait_for_end(self):
        """Until the node has closed the connection, and all that came before has been read."""
        self._thread.join(60.0)

    def close(self):
        self._connection.close()
