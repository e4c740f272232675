"""Reads motion files of drape (version 1), as docs/reference/motion-file.md describes them. Needs numpy.

A state's words encode differences from a prediction by earlier states. D is the word shifted right by one bit, with all bits
inverted if its lowest bit was 1. A number's bits are those of the prediction plus D, modulo 2^64. In every `group` of 32 states the
first is predicted from nothing. The lowest byte names the prediction of positions, the next that of velocities:

0            0
k = 1 to 4   the sum of w_i y_i over the k states before, nearest first; w_i is the product of (s - s_j)/(s_i - s_j) over j != i, in
             order, starting from 1; s are steps
5            for velocities: (x - x_1)/d, d = (s - s_1) h
6            for velocities: 2 (x - x_1)/d - v_1

Predictions use double precision, rounded after each operation, with sums from left to right.
"""

import json, struct, zlib
import numpy as np

class Motion:
    def __init__(self, name):
        self.file = open(name, "rb")
        if self.file.read(24) != b"drape recorded motion 1\n":
            raise ValueError("not a drape motion file of version 1")
        self.head = json.loads(unpack(self.block(24, b"HEAD")[0]))
        self.file.seek(-16, 2)
        offset, end = struct.unpack("<Q8s", self.file.read(16))
        if end != b"drapeend":
            raise ValueError("cut short")
        index = np.frombuffer(unpack(self.block(offset, b"INDX")[0]), "<u8")
        states = int(index[0])
        self.states = index[2:2 + 2 * states].reshape(-1, 2).astype(np.int64)
        self.row_blocks = index[2 + 2 * states:].reshape(-1, 2).astype(np.int64)

    def block(self, offset, tag):
        self.file.seek(int(offset))
        head = self.file.read(16)
        size, checksum = struct.unpack("<QI", head[4:])
        payload = self.file.read(size)
        if head[:4] != tag or zlib.crc32(head[:12] + payload) != checksum:
            raise ValueError("damaged")
        return payload, offset + 16 + size

    def surface(self):
        """Triangles, t x 3, and texture coordinates, t x 3 x 2."""
        _, offset = self.block(24, b"HEAD")
        for _ in self.head["files"]:
            _, offset = self.block(offset, b"FILE")
        data = unpack(self.block(offset, b"MESH")[0])
        end = 12 * self.head["triangles"]
        return (np.frombuffer(data[:end], "<i4").reshape(-1, 3),
                np.frombuffer(data[end:], "<f4").reshape(-1, 3, 2))

    def rows(self):
        """Steps x columns: kinetic, gravity, elastic, iterations, converged, residual, error, substeps, estimate, colliders…, cloths…"""
        parts = []
        for _, offset in self.row_blocks:
            payload, _ = self.block(offset, b"ROWS")
            _, count = struct.unpack("<QQ", payload[:16])
            parts.append(planes(payload[16:]).view(np.float64).reshape(-1, count).T)
        return np.concatenate(parts)

    def __iter__(self):
        """Every state: step, positions n x 3, velocities n x 3."""
        before = []                                      # nearest first: step, x, v
        for i, (step, offset) in enumerate(self.states):
            if i % self.head["group"] == 0:
                before = []
            payload, _ = self.block(offset, b"STAT")
            places, velocities = payload[8], payload[9]
            words = planes(payload[16:]).reshape(2, -1)
            x = undo(words[0], extrapolated(step, [(s, x) for s, x, v in before[:places]]))
            if velocities < 5:
                predicted = extrapolated(step, [(s, v) for s, x, v in before[:velocities]])
            else:
                s1, x1, v1 = before[0]
                predicted = (x - x1) / (float(step - s1) * self.head["step"])
                if velocities == 6:
                    predicted = 2 * predicted - v1
            v = undo(words[1], predicted)
            before = [(step, x, v)] + before[:3]
            yield int(step), x.reshape(3, -1).T, v.reshape(3, -1).T

def unpack(packed):
    return zlib.decompress(packed[8:])

def planes(packed):
    data = np.frombuffer(unpack(packed), np.uint8).reshape(8, -1).astype(np.uint64)
    words = np.zeros(data.shape[1], np.uint64)
    for plane in data:
        words = words << np.uint64(8) | plane
    return words

def extrapolated(step, known):
    total = 0.0
    for i, (si, y) in enumerate(known):
        w = 1.0
        for j, (sj, _) in enumerate(known):
            if j != i:
                w *= float(step - sj) / float(si - sj)
        total = w * y if i == 0 else total + w * y
    return total

def undo(words, predicted):
    d = words >> np.uint64(1) ^ np.uint64(0) - (words & np.uint64(1))
    return (d + (np.zeros(len(words)) + predicted).view(np.uint64)).view(np.float64)
