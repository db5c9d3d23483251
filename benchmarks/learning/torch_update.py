"""One update of the Q-network in PyTorch, as a researcher would write it: double-Q targets, forward,
backward, clipping, Adam. The network and the sizes are those of learning_benchmark (linewright/network/network.hpp).

usage: torch_update.py GROUPS ACTIONS WIDTH BATCH THREADS UPDATES
GROUPS: one word per group of tokens, NAME:TOKENS:FEATURES:ENCODER (shared, named or own)
Prints the median time of an update in milliseconds.
"""

import sys
import time

import torch
from torch import nn


class NoisyLinear(nn.Module):
    def __init__(self, inputs, outputs, sigma0=0.5):
        super().__init__()
        bound = inputs ** -0.5
        self.weight = nn.Parameter(torch.empty(outputs, inputs).uniform_(-bound, bound))
        self.bias = nn.Parameter(torch.empty(outputs).uniform_(-bound, bound))
        self.weight_sigma = nn.Parameter(torch.full((outputs, inputs), sigma0 * bound))
        self.bias_sigma = nn.Parameter(torch.full((outputs,), sigma0 * bound))

    def forward(self, x):
        noise = lambda n: (lambda e: e.sign() * e.abs().sqrt())(torch.randn(x.shape[0], *[1] * (x.dim() - 2), n))
        n_in, n_out = noise(x.shape[-1]), noise(self.weight.shape[0])
        mean = nn.functional.linear(x, self.weight, self.bias)
        return mean + (nn.functional.linear(x * n_in, self.weight_sigma) + self.bias_sigma) * n_out


def feedforward(width, inner):
    return nn.Sequential(nn.Linear(width, inner), nn.ReLU(), nn.Linear(inner, width))


class Attention(nn.Module):
    def __init__(self, width, heads):
        super().__init__()
        self.heads = heads
        self.q, self.kv, self.out = nn.Linear(width, width), nn.Linear(width, 2 * width), nn.Linear(width, width)

    def forward(self, query, memory, absent):
        b, _, d = query.shape
        split = lambda x: x.view(b, -1, self.heads, d // self.heads).transpose(1, 2)
        k, v = self.kv(memory).chunk(2, -1)
        scores = split(self.q(query)) @ split(k).transpose(-2, -1) * (d // self.heads) ** -0.5
        weights = scores.masked_fill(absent[:, None, None, :], float("-inf")).softmax(-1)
        return self.out((weights @ split(v)).transpose(1, 2).reshape(b, -1, d))


class QNetwork(nn.Module):
    def __init__(self, groups, actions, width, heads=4):
        super().__init__()
        self.groups, self.actions = groups, actions
        self.encoders = nn.ParameterList()
        self.biases = nn.ParameterList()
        for _, tokens, features, encoder in groups:
            own = tokens if encoder == "own" else 1
            self.encoders.append(nn.Parameter(torch.randn(own, features, width) * features ** -0.5))
            self.biases.append(nn.Parameter(torch.zeros(1 if encoder == "shared" else tokens, width)))
        norm = lambda: nn.LayerNorm(width)
        self.norm1, self.norm2 = norm(), norm()
        self.self_attention, self.ff = Attention(width, heads), feedforward(width, 2 * width)
        self.norm_query, self.norm_memory, self.norm_ff, self.norm_out = norm(), norm(), norm(), norm()
        self.cross_attention, self.cross_ff = Attention(width, heads), feedforward(width, 2 * width)
        stream = lambda: nn.Sequential(NoisyLinear(width, 64), nn.ReLU(), NoisyLinear(64, 1))
        self.advantage, self.value = stream(), stream()

    def forward(self, features, absent):
        rows, at = [], 0
        for (_, tokens, size, _), weight, bias in zip(self.groups, self.encoders, self.biases):
            part = features[:, at:at + tokens * size].view(-1, tokens, size)
            rows.append(torch.einsum("btf,tfd->btd", part, weight.expand(tokens, -1, -1)) + bias)
            at += tokens * size
        x = torch.cat(rows, 1)
        h = self.norm1(x)
        x = x + self.self_attention(h, h, absent)
        x = x + self.ff(self.norm2(x))
        queries = x[:, -1 - self.actions:-1]
        u = queries + self.cross_attention(self.norm_query(queries), self.norm_memory(x), absent)
        u = self.norm_out(u + self.cross_ff(self.norm_ff(u)))
        a, v = self.advantage(u).squeeze(-1), self.value(u.mean(1))
        return v + a - a.mean(1, keepdim=True)


def main():
    groups = []
    for word in sys.argv[1].split(","):
        name, tokens, features, encoder = word.split(":")
        groups.append((name, int(tokens), int(features), encoder))
    actions, width, batch, threads, updates = map(int, sys.argv[2:])
    torch.set_num_threads(threads)
    online, target = QNetwork(groups, actions, width), QNetwork(groups, actions, width)
    adam = torch.optim.Adam(online.parameters(), lr=1e-4, eps=1.5e-4)
    size = sum(t * f for _, t, f, _ in groups)
    tokens = sum(t for _, t, _, _ in groups)
    states, following = torch.rand(2, batch, size)
    absent = torch.zeros(batch, tokens, dtype=torch.bool)
    absent[:, 1:5] = True
    action = torch.zeros(batch, 1, dtype=torch.long)
    times = []
    for update in range(updates + 3):
        start = time.perf_counter()
        with torch.no_grad():
            choice = online(following, absent).argmax(1, keepdim=True)
            wanted = 0.1 + 0.99 * target(following, absent).gather(1, choice)
        loss = (wanted - online(states, absent).gather(1, action)).square().mean()
        adam.zero_grad()
        loss.backward()
        nn.utils.clip_grad_norm_(online.parameters(), 10.0)
        adam.step()
        if update >= 3:
            times.append(1000.0 * (time.perf_counter() - start))
    print(f"{sorted(times)[len(times) // 2]:.2f}")


if __name__ == "__main__":
    main()
