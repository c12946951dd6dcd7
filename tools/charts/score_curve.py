"""Precision and recall by threshold on the score, of score.csv."""


class ScoreCurve:
    """`believed`, `right`: ticks, and right ticks, with at least each threshold's score."""

    def __init__(self, thresholds, believed, right):
        self.thresholds = thresholds
        self.precision = [100 * r / b if b else 100 for b, r in zip(believed, right)]
        self.recall = [100 * r / right[0] if right[0] else 0 for r in right]

    def best(self):
        """The threshold with the best F1; among equals, the highest."""

        def f1(i):
            both = self.precision[i] + self.recall[i]
            return self.precision[i] * self.recall[i] / both if both else 0

        return self.thresholds[max(range(len(self.thresholds)), key=lambda i: (f1(i), i))]

    def area(self):
        """Under precision over recall, 0 to 1."""
        gains = [a - b for a, b in zip(self.recall, self.recall[1:] + [0])]
        return sum(gain * precision for gain, precision in zip(gains, self.precision)) / 1e4

    def draw(self, axes, colours):
        axes.axvline(self.best(), color="#969696", linewidth=1, label="best F1")
        axes.plot(self.thresholds, self.precision, color=colours[0],
                  label="precision: believed ticks\nthat are within 4 px")
        axes.plot(self.thresholds, self.recall, color=colours[1],
                  label="recall: ticks within 4 px\nthat are believed")
        axes.set(xlim=(0, 1), ylim=(0, 103))
