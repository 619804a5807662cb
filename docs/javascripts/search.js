// SPDX-License-Identifier: Apache-2.0
// The search of the theme finds every word that begins with a word of the query: "a" finds all pages with "action" or
// "asyncio". This script removes words that carry no meaning before the query reaches the worker.
{
  const QUERY = 2; // the type of the theme's messages with a query
  const FILLER = new Set(
    ("a an and are as at be by can do does for from how i in into is it its me my of on one or our so some that the " +
      "their this to use using want we what when where which who why will with you your").split(" "),
  );
  const withoutFiller = (query) => {
    const words = query.split(/\s+/).filter((word) => word && !FILLER.has(word.toLowerCase().replace(/^\+/, "")));
    return words.length > 0 ? words.join(" ") : query;
  };
  const post = Worker.prototype.postMessage;
  Worker.prototype.postMessage = function (message, ...rest) {
    const isQuery = message?.type === QUERY && typeof message.data === "string";
    return post.call(this, isQuery ? { ...message, data: withoutFiller(message.data) } : message, ...rest);
  };
}
