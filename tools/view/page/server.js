// Requests to puck-view. A lost connection is told to `onConnection(problem)`; '' when it is back.

let onConnection = () => {};
let problem = '';

export function whenConnectionChanges(callback) {
  onConnection = callback;
}

function tell(text) {
  if (text === problem) return;
  problem = text;
  onConnection(text);
}

// The reply, or null after telling why there is none.
async function ask(path, options) {
  try {
    const reply = await fetch(path, options);
    if (reply.ok) {
      tell('');
      return reply;
    }
    tell((await reply.text()).trim() || `puck-view answered ${reply.status}`);
  } catch (error) {
    if (error.name !== 'AbortError') {
      tell('puck-view does not answer: it has ended, or the line to it is down. This page goes on when it is back.');
    }
  }
  return null;
}

export async function getJson(path) {
  const reply = await ask(path);
  return reply && reply.json();
}

// The newest picture as {version, blob}, {} if nothing changed, or null without a reply.
export async function getPicture(query, signal) {
  const reply = await ask(`picture?${query}`, { signal });
  if (!reply) return null;
  if (reply.status === 204) return {};
  try {
    return { version: reply.headers.get('Puck-Version'), blob: await reply.blob() };
  } catch {
    return null; // Given up half way.
  }
}

// Empty on success, else why not.
export async function control(action, fields = {}) {
  const reply = await ask('control', {
    method: 'POST',
    headers: { 'Content-Type': 'application/json' },
    body: JSON.stringify({ action, ...fields }),
  });
  return reply ? (await reply.json()).problem : '';
}

export const pause = (milliseconds) => new Promise((done) => setTimeout(done, milliseconds));
